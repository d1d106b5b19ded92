// Surfaces that are shaded alike, and their share of the list of a wave's records.

struct Group {
    uint count;
    uint first;      // of its records in the list
    uint listed;     // so far
    uint unused;
};

