"""Letters, problems, objective and layout: frozen data that every stage shares."""
