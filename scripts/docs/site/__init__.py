"""The documentation as a site of plain files, with live views: ``python -m scripts.docs.site``, or ``make docs``."""
