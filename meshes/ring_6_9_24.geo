// The annulus of ring_6_9.geo with 24 elements round, 1 radially.
quarter = 6;    // elements in 90 degrees
radial = 1;     // elements from bore to outside
Include "ring_6_9.geo";
