"""Writes the files of this folder: python3 make.py (NumPy, pyuff 2.5.8).

responses.uff: accelerance at even frequencies in double precision, receptance at uneven ones, mobility at even ones in
single precision, a coherence and a time signal, which are no frequency responses. millimetre.uff: receptance in mm/N.
binary.uff: the first as dataset 58b. times.uff: signals over time, x_k = sin(0.7 k) + k / 8 m/s^2, step 1/128 s,
as text (even, uneven), as dataset 58b, and in g (once without a name), after a frequency response and mm as the unit of
length.
"""

import pathlib

import numpy as np
import pyuff

even = 2.5 + 0.5 * np.arange(7)
uneven = np.array([1.0, 2.5, 10.25, 400.5])


def value(f):
    return (1 + 0.25j * f) / (3.25 - f) * 1e-6


def function(x, data, spacing, **more):
    return {
        "type": 58, "func_type": 4, "rsp_node": 17, "rsp_dir": -3, "ref_node": 4, "ref_dir": 1,
        "rsp_ent_name": "FOOT", "ref_ent_name": "SHAFT", "id1": "from pyuff", "x": x, "data": data,
        "abscissa_spacing": spacing, "abscissa_spec_data_type": 18, "ordinate_spec_data_type": 12,
        "orddenom_spec_data_type": 13, "ordinate_axis_lab": "Acceleration", "ordinate_axis_units_lab": "m/s2",
        "orddenom_axis_lab": "Force", "orddenom_axis_units_lab": "N", **more,
    }


def write(name, sets):
    # what "overwrite" begins it writes over again after binary numbers
    pathlib.Path(name).unlink(missing_ok=True)
    pyuff.UFF(name).write_sets(sets, mode="add")


first = function(even, value(even), 1)
receptance = {"ordinate_spec_data_type": 8, "ordinate_axis_lab": "Displacement", "ordinate_axis_units_lab": "m"}
write("responses.uff", [
    first,
    function(uneven, value(uneven), 0, **receptance),
    function(even, abs(value(even)) / 1e-6, 1, func_type=6),
    function(even, abs(value(even)), 1, func_type=1, abscissa_spec_data_type=17),
])
single = function(even, value(even), 1, ordinate_spec_data_type=11, ord_data_type=5, rsp_ent_name="NONE", rsp_node=0,
                  rsp_dir=0)
pyuff.UFF("responses.uff").write_sets([single], mode="add", force_double=False)
units = {"type": 164, "units_code": 5, "units_description": "mm", "temp_mode": 1, "length": 1e3, "force": 1.0,
         "temp": 1.0, "temp_offset": 273.15}
write("millimetre.uff", [units, function(uneven, value(uneven) * 1e3, 0, **receptance)])
write("binary.uff", [{**first, "binary": 1}])

k = np.arange(11)
instants, signal = 2.5 + k / 128, np.sin(0.7 * k) + k / 8
acceleration = {"func_type": 1, "abscissa_spec_data_type": 17, "abscissa_axis_lab": "Time", "abscissa_axis_units_lab": "s",
                "orddenom_spec_data_type": 0, "orddenom_axis_lab": "NONE", "orddenom_axis_units_lab": "NONE",
                "abscissa_min": 2.5, "abscissa_inc": 1 / 128}
top = function(instants, signal * 1e3, 1, **acceleration, id1="top", ord_data_type=4)
in_g = {**top, "id1": "in g", "ordinate_axis_units_lab": "g", "data": signal}
write("times.uff", [
    units, function(even, value(even), 1), top,
    {**top, "id1": "uneven", "abscissa_spacing": 0}, {**top, "id1": "binary", "binary": 1}, {**in_g, "id1": "NONE"},
    in_g,
])
