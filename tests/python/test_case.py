"""Cases: read, made of a dict, changed, refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import plummer

RING = "examples/modal/ring.toml"
DENT = "examples/tadina2011/outer-dent.toml"


def test_keys_are_read_with_their_defaults() -> None:
    case = plummer.Case.load(DENT)
    assert case["bearing.balls"] == 7
    assert case["bearing.defects.0.depth"] == case["bearing.defects[0].depth"] == 1.5e-05
    assert case["transient.ensemble.runs"] == case.to_dict()["transient"]["ensemble"]["runs"]
    assert "bearing.defects" in case and "bearing.defects.9" not in case
    for key in ("bearing.nothing", "bearing.defects.first", "bearing.defects.7", "title.x"):
        with pytest.raises(KeyError):
            case[key]


def test_what_is_set_is_what_the_command_sets() -> None:
    case = plummer.Case.load(DENT, set=["transient.end=2.5"])
    case["bearing.defects.0.depth"] = np.float64(2e-5)
    case["analysis.envelope"] = [{"from": 0.1, "to": 0.4}]
    case["title"] = 'a "quoted" title'
    case["bearing.balls"] = np.int64(7)
    assert case.settings == [
        "transient.end=2.5",
        "bearing.defects.0.depth=0.00002",
        "analysis.envelope=[{ from = 0.1, to = 0.4 }]",
        "title='a \"quoted\" title'",
        "bearing.balls=7",
    ]
    assert case["bearing.defects.0.depth"] == 2e-5
    assert case.title == 'a "quoted" title'


def test_a_refused_value_leaves_the_case_as_it_was() -> None:
    case = plummer.Case.load(DENT)
    with pytest.raises(plummer.CaseError, match="bearing.balls"):
        case["bearing.balls"] = -1
    assert case["bearing.balls"] == 7 and case.settings == []
    with pytest.raises(TypeError, match="NoneType"):
        case["bearing.balls"] = None


def test_several_keys_are_checked_together() -> None:
    case = plummer.Case.load(DENT)
    # each of them alone contradicts the window
    case.update({"transient.end": 0.2, "analysis.envelope": [{"from": 0.05, "to": 0.2}]})
    assert case["transient.end"] == 0.2


def test_a_copy_is_its_own() -> None:
    case = plummer.Case.load(RING)
    other = case.copy()
    other["modes.count"] = 5
    assert case["modes.count"] != 5


def test_a_dict_is_a_case() -> None:
    loaded = plummer.Case.load(RING).to_dict()
    housing = {**loaded["housing"], "mesh": Path(loaded["housing"]["mesh"]).resolve()}
    table = {"title": "plate", "materials": loaded["materials"], "housing": housing, "ring": None, "modes": {"count": np.int64(6)}}
    case = plummer.Case(table)
    frequencies = case.modes().frequencies_hz
    own = plummer.Case.load(RING, set={"modes": {"count": 6}}).modes().frequencies_hz
    np.testing.assert_array_equal(frequencies, own)
    assert case.title == "plate"


def test_a_dict_that_is_no_case_is_refused() -> None:
    with pytest.raises(plummer.CaseError, match="unknown key `housng`"):
        plummer.Case({"housng": {}})
    with pytest.raises(TypeError, match="object"):
        plummer.Case({"title": object()})
