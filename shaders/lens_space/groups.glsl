// Describes a group of surfaces with the same shader. The records (ray hits) of these surfaces are contiguous in a list
// of all records of the rays that are traced together.

struct Group {
    uint count;
    uint first;      // index in the list of the group's first record (ray hit)
    uint listed;     // number of the group's records listed so far
    uint unused;
};

