"""What makes the pictures of the README and the pictures and tables of the docs. No part of the package."""
