"""What is measured; `python -m tests.bench` prints it."""
