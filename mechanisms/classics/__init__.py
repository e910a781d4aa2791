"""Classic linkages, one file each: their known properties are truth for the tests."""
