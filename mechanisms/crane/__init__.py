"""A forestry crane: its skeleton, its drives, what it lifts."""
