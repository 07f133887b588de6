"""What more than one family of models uses."""
