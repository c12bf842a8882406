"""The site: what it is made of, and the site itself, made once and opened in a browser."""
