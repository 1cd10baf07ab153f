"""Commands that are killed, starved and interrupted, and what they leave."""
