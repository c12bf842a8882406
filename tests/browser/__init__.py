"""The widgets in a real JupyterLab, Notebook and Voilà, in headless Chromium, without a network."""
