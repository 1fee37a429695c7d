//! Every check fires on the superelement that is broken in its way.
