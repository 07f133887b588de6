"""What the motion player shows: bodies in space, on the ground and seen from the side."""
