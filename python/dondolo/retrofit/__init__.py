"""Effect of strengthening a wall."""
