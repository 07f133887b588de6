"""What a user asks to be filled, and what is said if that cannot be met."""
