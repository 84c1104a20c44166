"""A tram's route: its sections, the growth of wheel orders on them, kilometres to a limit."""
