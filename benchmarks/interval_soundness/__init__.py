"""Random graphs over random boxes: no value outside its enclosure."""
