// A group of surfaces with the same shader, and its range in the list of a wave's records.

struct Group {
    uint count;
    uint first;      // index of its first record in the list
    uint listed;     // number of records listed so far
    uint unused;
};

