"""What is registered, as plain values, and what tables say of it without loading it."""
