"""What is measured; `python -m tests.bench` prints it.

Figures are of one thread: linear algebra is told so before NumPy is loaded.
"""

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")
