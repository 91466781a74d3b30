GOLDEN(none, none, 0, 0)
