"""What the solver is tuned by: how far it goes, what helps it when, and within which bounds. One place, with units.

None of these changes an answer that is proven. They decide how soon it is found, what there is when the time is up, and
when something is given up; whatever is given up shows in `proven`, in the gap, and in a warning. *Effort* is counted,
in seconds of a usual machine (`effort`). The compiled search has copies of some in its headers; tests hold both to the
same steps.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

# Words (words/, analysis/)

MAX_WORDS = 2000
"""Words that a pattern with three counters or more is left with, about: those nearest to the canvas."""
MAX_WORDS_OF_FEW = 20_000
"""The same with one counter or two."""
MAX_LETTERS_IN_ALL = 400_000
"""Letters in all words of a pattern together; the words nearest to the canvas come first."""
MAX_COPIES = 16
"""Count up to which a counter is tried that repeats only letters without a size; it could go on for ever."""
MAX_SAMPLES = 1_000_000
"""Words that sampled sizes make of one, at most."""
SUM_CELLS = 4096
"""Cells of a table of the sizes that some counters can add up to (`words.counter_values`)."""
SUM_FEW = 2000
"""With fewer values than this a table is not worth its making."""
MAX_VARIANTS = 32
"""Ways to choose the alternatives of a pattern that pattern analysis looks at."""
MAX_TERMS = 2_000
"""Terms of a flattened pattern, and letters in the base of one, that pattern analysis takes."""

# Turns of candidates and their groups (selection/)

FIRST_STEP = 0.004
"""How far above its lower bound a candidate goes first, as a fraction of the canvas."""
STEP_GROWTH = 1.5
"""Each turn takes it so many times further."""
TURN_PATHS = 150
"""After so many paths a search gives way to those of other candidates."""
TIES = 4
"""Equally good structures that are kept; sizing chooses among them."""
PATHS = 1_000_000
"""A search of more paths gives up; under the paper's objective, and where structures are refused, of a fiftieth."""
TOLD_LETTERS = 200
"""A word that stands alone is searched like others where somebody watches, if it has no more letters."""

# What helps a search that takes long (selection/, alignment/heuristic/, alignment/reference/dives)

SLOW = 0.03
"""Effort after which a search is helped by sweeps."""
SLOW_ELASTIC = 0.5
"""The same where there are placeholders, which take longer to sweep."""
LONG_PATHS = 3_000
"""Paths after which a search is a long one, and dives help it."""
PAPER_PATHS = 4_000
"""Partial alignments of which the paper's search has to come to something at first; then of four times as many."""
LONG_EFFORT = 0.5
"""Effort of searches after which other candidates are swept, with the part of it that comes next:"""
SWEPT_PART = 0.3
LIKELY: Mapping[str, int] = {"sweep": 24, "mend": 3, "dive": 3}
"""Candidates of which a layout is looked for in these ways, when the time is up."""
SWEEPS = 12
"""Rounds in which every row is laid back in once, at most."""
SWEEP_ROUNDS = 3
"""Times that unsized symbols are given the sizes that they have come to."""
LESS_STRAIN = 0.98
"""To this part a step of mending has to lessen the strain."""
SWEPT_LETTERS = 60
"""Words of more letters are not swept: there are as many ways to lay one as the cube of its length."""
PLACES = 160
"""Places closer than this part of the canvas count as one."""
ELEMENTS = 300_000
"""With more elements than this between places, wide columns are not looked at to begin with."""
SPANS = 300_000
"""A row with placeholders may join so many columns for one of its letters that no more elements are looked at."""
DIVE_DEPTHS = 40
"""Depths at which a dive takes up paths, about."""
DIVE_COLUMNS = 24
"""Columns of a path that a dive looks at, of each width, in a tall stack."""
DIVE_PATIENCE = 5
"""Dives without an answer after which dearer ones are looked for."""
DIVE_STEP = 0.003
"""How much dearer than a path the first of its columns may be in a dive, as a fraction of the canvas."""

# The best-first search and its bounds (alignment/group, alignment/reference/)

TALL = 6
"""Rigid bands from which on a group's columns are looked for by their skeleton."""
PAIRED = 12
"""With more bands than this, pairs say too little for what they take to be compared."""
TALL_STEP = 0.002
"""How much dearer than a path the first of its columns may be in a tall stack, as a fraction of the canvas."""
FURTHER = 0.01
"""How much further than asked edges are made, as a fraction of the canvas: limits grow in small steps."""
SKELETON_COARSE = 20
"""The first cells of a skeleton are this part of the canvas."""
SKELETON_ROUNDS = 6
"""Times that they are made finer, at most."""
SKELETON_CELLS = 150
"""Cells, at most."""
SKELETON_BINS = 14
"""Steps into which ω is divided."""
SKELETON_WINDOW = 6
"""A row that may stand at more letters than this, on average, says too little to be asked."""

# The paper's search (alignment/paper/), and both in turn (alignment/single)

LIMIT_GROWTH = 2.0
"""Each limit of the deepening is that many times further from the lower bound."""
DEAR_PASS = 1000
"""After a pass with more partial alignments, which will not be shorter next time, the limit grows faster."""
IDLE_JOINS = 1000
"""After so many joined alignments in a row that were no better than what was known, a pass goes on forward alone."""
INCUMBENT_PATHS = 300
"""Partial alignments that each search for a good alignment may take up."""
ALIGN_TURNS: Mapping[str, Sequence[int]] = {
    "best": (20_000, 150_000, 1_000_000),
    "ida": (4_000, 30_000, 100_000),
}
"""Partial alignments after which a search gives way to the other; after the last, the best so far is taken."""
ALIGN_PATH = 2e-4
"""Effort that a partial alignment takes in Python."""

# The compiled search (alignment/core/)

INSTANCE_BYTES = 3 * 2**28
"""Addresses that are reserved for an instance, beyond which it may not grow; the clock stops it before."""
GUARD_BYTES = 2**16
"""Addresses in front of it and behind it where nothing may be."""
LARGE_INSTANCE = 64 * 2**20
"""Bytes beyond which an instance is let go of once nothing is left in it."""
IDLE_INSTANCE = 32 * 2**20
"""Bytes up to which an instance is kept for the next call, once nothing is left in it."""
LET_GO = 8
"""Things no longer needed that are let go of at once, or fewer where memory is short."""
WORK_PER_SECOND = 4e8
"""Work, as it counts it, that is done in a second of a usual machine."""

# Effort: seconds of a usual machine (effort)

CALL = 5e-5
"""What is done between two looks at the clock, about."""
SWEPT = 6e-4
"""The same in sweeps."""
ALIGNED = 3e-4
"""To price an alignment in Python."""
SIZED = 1e-3
"""To size one."""
EXTENDED = 4e-5
"""To make a path of the paper's search longer by a column."""
RELAXED = 4e-4
"""To bound one by a linear programme."""

# Time and memory of a call (budget, solution)

MERGING_MOMENT = 0.15
"""Seconds that merging may take when the search has used up its time."""
LAST_ATTEMPT = 0.5
"""Seconds that the last attempt may take."""
MEMORY = 400_000_000
"""Bytes by which the process may grow during a search; what earlier ones have left counts, up to a half of it."""
MEMORY_LOOK = 0.02
"""Seconds between two looks at the memory."""

# Sizing (sizing/)

LONG_AXIS = 1000
"""With more letters than this only sizes are variables, where all else follows from them."""
SIZING_CELLS = 12_000_000
"""Numbers in the matrices of a system: a solver for small ones would take minutes, and memory, for more."""

# Bytes as which kept answers count, about (cache)

ELEMENT_BYTES = 500
"""An element of a structure."""
LETTER_BYTES = 150
"""A letter of a band."""
WORD_BYTES = 500
"""A word without letters."""
WORD_LETTER_BYTES = 8
"""A letter in a word."""
ANSWER_BYTES = 500_000
"""An answer of an axis, at least: no more than 64 are kept."""

# Reasons and remedies (diagnosis/)

REMEDIES = 0.6
"""Effort of trying what would help, where there is no layout."""
REMEDY = 0.2
"""Of it, for one change."""
ASIDE = 0.3
"""Effort that a trial may take that only the explanation needs."""
TRIED = 8
"""Candidates that are tried to see whether an axis can be aligned at all."""
COMPARED = 20_000
"""Candidates of which the values of counters are compared."""
FACTORS = (1.01, 1.02, 1.05, 1.1, 1.2, 1.35, 1.5, 2.0, 3.0, 5.0)
"""Parts and multiples of a length that are tried, the nearest first."""
FINER = 4
"""Times that the step between one that fails and one that works is halved."""
