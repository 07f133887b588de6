"""What the motion player shows: bodies placed in space, set on the ground and seen from the side."""
