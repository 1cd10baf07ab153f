"""Bad input for every entry: generated from seeds, counted by how it ends."""
