"""The drawing board: a page on which a machine is drawn, moves, and is written as a class."""
