// Describes a group of surfaces with the same shader. The records (ray hits) of these surfaces are contiguous in a list
// of all records of the rays that are traced together.

struct Group {
    uint count;
    uint first;      // position of the group's first record in the list
    uint listed;     // how many of the group's records have been written to the list so far
    uint unused;
};

