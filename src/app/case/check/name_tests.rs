//! Names: each once in its list, and those of sensors as arrays have them.

use super::super::tests::FULL;
use super::tests::{breaks, full, holds};

#[test]
fn nothing_stands_twice() {
    let twice = |name: &str| format!("\"{name}\" stands here a second time, expected each once");
    full("housing.supports[0].fixed=[\"x\",\"x\"]", &twice("x"));
    full("sensors[2].name=P1", &twice("P1"));
    breaks(
        FULL,
        &["housing.parts=[{group='a',material='steel'},{group='a',material='steel'}]"],
        "housing.parts[1].group",
        &twice("a"),
    );
    for mesh in ["pedestal.msh", "pedestal_coarse.msh"] {
        // the case's own, or one of the others again
        full(
            &format!("modes.convergence.meshes[1]={mesh}"),
            &twice(&format!("folder/{mesh}")),
        );
    }
    full(
        "sensors[0].name=shaft_x",
        "\"shaft_x\" is the name of another signal",
    );
    full(
        "sensors[0].name='../P1'",
        "found \"../P1\", expected letters, digits, `_`, `-`, `.` and spaces: the signal is saved under this name",
    );
    holds(FULL, &["sensors[0].name='Датчик 1'"]);
}
