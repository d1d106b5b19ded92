// A group of surfaces with the same shader, and the group's range in the list of a wave's records (ray hits).

struct Group {
    uint count;
    uint first;      // index of the group's first record in the list
    uint listed;     // number of records listed so far
    uint unused;
};

