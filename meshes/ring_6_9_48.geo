// The annulus of ring_6_9.geo with 48 elements round, 2 radially.
quarter = 12;   // elements in 90 degrees
radial = 2;     // elements from bore to outside
Include "ring_6_9.geo";
