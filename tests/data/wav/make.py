"""A sound file of doubles by SciPy 1.17.1 (NumPy 2.4.6): python3 make.py writes float64.wav beside this file.

Channel 1 is sin(0.7 k) + k / 8, channel 2 is 1 + 2^-40, which single precision would round to 1.
"""

from pathlib import Path

import numpy as np
from scipy.io import wavfile

k = np.arange(12)
samples = np.stack([np.sin(0.7 * k) + k / 8, np.full(12, 1 + 2.0**-40)], axis=1)
wavfile.write(Path(__file__).parent / "float64.wav", 48000, samples)
