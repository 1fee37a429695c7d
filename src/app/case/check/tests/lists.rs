//! Lists, names and directions: something in each, each once, and those of sensors as arrays have them.

use super::{breaks, full, holds};
use crate::app::case::tests::FULL;

#[test]
fn lists_and_names_that_must_hold_something_do() {
    for (argument, expected) in [
        ("housing.parts=[]", "at least one part"),
        ("housing.supports[0].fixed=[]", "at least one of x, y, z"),
        ("housing.supports[1].spring={}", "a stiffness above 0"),
        ("ring.supports[0].spring={x=0}", "a stiffness above 0"),
        ("ring.sections=[]", "at least one section"),
        ("speed.profile=[]", "at least one point"),
        ("sensors[0].name=\"\"", "a name"),
        ("modes.variants[0].set=[]", "at least one KEY=VALUE"),
        ("modes.convergence.meshes=[]", "at least one other mesh"),
    ] {
        full(argument, &format!("found nothing, expected {expected}"));
    }
}

#[test]
fn entries_of_a_report_say_something_in_one_line() {
    full("report.author=\"\"", "found an empty text, expected some text");
    full("report.title=\"a\\nb\"", "found the control character \\n, expected one line of text");
    let long = format!("report.customer=\"{}\"", "a".repeat(501));
    full(&long, "found 501 characters, expected 500 at most");
    holds(FULL, &["report.remark=\"a\\nb\""]);
}

#[test]
fn a_link_connects_two_groups() {
    full("housing.links[0].between=['lid','lid']", "\"lid\" stands here a second time, expected each once");
}

#[test]
fn a_plane_has_no_third_axis() {
    let rule = "found a component z, expected x and y only in a plane model";
    full("housing.supports[0].fixed=[\"x\",\"z\"]", rule);
    full("housing.supports[1].spring={z=1}", rule);
    full("housing.links[1].spring={z=1}", rule);
    full("ring.supports[0].spring={z=1}", rule);
    let solid = FULL.replace("plane = {", "#");
    holds(&solid, &["housing.supports[0].fixed=[\"z\"]"]);
    holds(&solid, &["housing.supports[1].spring={z=1}"]);
    holds(&solid, &["ring.supports[0].spring={z=1}"]);
}

#[test]
fn directions_point_somewhere() {
    let nowhere = "found a vector of length zero, expected a direction";
    for key in ["ring.tie.axis", "ring.tie.zero_deg", "sensors[0].direction"] {
        full(&format!("{key}=[0,0.0,0]"), nowhere);
    }
    let along = "found the direction of `ring.tie.axis`, expected one across it";
    full("ring.tie.zero_deg=[0,0,-2]", along);
    holds(FULL, &["ring.tie.zero_deg=[1,0,-2]"]);
}

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
        full(&format!("modes.convergence.meshes[1]={mesh}"), &twice(&format!("folder/{mesh}")));
    }
    full("sensors[0].name=shaft_x", "\"shaft_x\" is the name of another signal");
    full("sensors[0].name=shaft_speed_hz", "\"shaft_speed_hz\" is the name of another signal");
    full(
        "sensors[0].name='../P1'",
        "found \"../P1\", expected letters, digits, `_`, `-`, `.` and spaces: the signal is saved under this name",
    );
    holds(FULL, &["sensors[0].name='Датчик 1'"]);
}
