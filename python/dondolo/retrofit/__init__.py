"""What a strengthening of a wall gains."""
