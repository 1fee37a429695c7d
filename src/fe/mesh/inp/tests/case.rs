//! What a deck says of the case: materials, sections, boundaries and their steps.

use super::{CUBES, read};
use crate::fe::mesh::{DeckMaterial, DeckSupport, Mesh};

/// Sections by sets, one of them internal; one body of no section; boundaries before the step and in it.
#[test]
fn materials_and_what_is_held_are_notes() {
    let case = "*MATERIAL, NAME=Steel\n*DENSITY\n7.85E-9\n*ELASTIC, TYPE=ISO\n2.1e5, 0.3\n*CONDUCTIVITY\n50.\n\
        *MATERIAL, NAME=Hot\n*ELASTIC\n7.e4, .33, 20.\n6.e4, .33, 200.\n*DENSITY\n2.7E-9,\n\
        *SOLID SECTION, ELSET=both, MATERIAL=hot\n*SOLID SECTION, ELSET=_p, MATERIAL=STEEL\n\
        *BOUNDARY\nfeet, 1, 2\nsensor, 2, 6\n11, 1\n11, 2\n12, 3\nsensor, 1, 1, 0.5\nmixed, XSYMM\nnall, 11, 11, 20.\n\
        *STEP\n*FREQUENCY\n10\n*BOUNDARY\nFEET, 3\nNall, 1\n*END STEP\n*STEP\n*BOUNDARY\nsensor, 1\n";
    let deck = CUBES.replace("*ELSET, ELSET=both", "*ELSET, ELSET=_p, INTERNAL\n20\n*ELSET, ELSET=both");
    let deck = deck.split("*MATERIAL").next().unwrap().to_owned() + case;
    let mesh = read(deck.as_bytes()).unwrap();
    let notes = &mesh.notes;
    let material = |name: &str, groups: &[&str], elastic, density| DeckMaterial {
        name: name.to_owned(),
        groups: groups.iter().map(|&group| group.to_owned()).collect(),
        elastic,
        density,
        first_line: name == "Hot",
        ..DeckMaterial::default()
    };
    // the second section takes one of two bodies from the first
    let steel = material("Steel", &["Upper", "_p"], Some([2.1e5, 0.3]), Some(7.85e-9));
    assert_eq!(notes.materials, [steel, material("Hot", &["lower one"], Some([7e4, 0.33]), Some(2.7e-9))]);
    assert_eq!(held(&mesh), ["Feet xyz", "mixed x", "sensor xyz"]);
    assert_eq!(
        notes.not_supports,
        [
            "the file has 2 steps: *BOUNDARY counts up to step 1, the first that has *FREQUENCY",
            "*BOUNDARY holds \"Nall\", the set of all nodes: no support holds a whole body",
            "*BOUNDARY has lines with values (1, first line 64): their directions are held, and the values are not used",
            "*BOUNDARY holds single nodes (2, first in line 61), which are no support: put them into an *NSET",
        ]
    );
    assert_eq!(notes.passed_over, ["*CONDUCTIVITY", "*HEADING"]);
    // in axes of their own only what is held all round is known; what a step begins anew is not held any more
    let turned =
        read(deck.replace("*BOUNDARY\nfeet", "*TRANSFORM, NSET=Nall\n0,1,0,1,0,0\n*BOUNDARY\nfeet").as_bytes());
    let turned = turned.unwrap();
    assert_eq!(held(&turned), [""; 0]);
    assert!(turned.notes.supports.iter().any(|named| named.group == "Feet"), "{:?}", turned.notes);
    let anew = read(deck.replace("*BOUNDARY\nFEET", "*BOUNDARY, OP=NEW\nFEET").as_bytes()).unwrap();
    assert_eq!(held(&anew), ["Feet z"]);
    assert_eq!(anew.notes.not_supports, notes.not_supports[..2]);
    let other = deck.replace("*FREQUENCY", "*INCLUDE, INPUT=held.inp\n*FREQUENCY");
    let other = read(other.as_bytes()).unwrap().notes.not_supports;
    let [_, _, _, _, include] = &other[..] else { panic!("{other:?}") };
    assert!(include.starts_with("*INCLUDE in line 68 takes another file into a step"), "{include}");
    let later = deck.replace("*END STEP\n*STEP\n", "*END STEP\n*STEP\n*INCLUDE, INPUT=held.inp\n");
    assert_eq!(read(later.as_bytes()).unwrap().notes.not_supports, notes.not_supports);
    // what was picked in Abaqus/CAE, and a surface of the set's name
    let picked = read(deck.replace("NSET=Feet, GENERATE", "NSET=Feet, GENERATE, INTERNAL").as_bytes()).unwrap().notes;
    assert_eq!(picked.supports[0].group, "Feet");
    let surface =
        read(deck.replace("*SURFACE, NAME=skin", "*SURFACE, NAME=FEET\nlower one, S1\n*SURFACE, NAME=skin").as_bytes());
    assert_eq!(surface.unwrap().notes.supports[0].group, "FEET");
    let moving = read(deck.replace("*BOUNDARY\nFEET", "*BOUNDARY, OP=NEW, TYPE=VELOCITY\nFEET").as_bytes());
    assert_eq!(held(&moving.unwrap()), [""; 0]);
}

/// Groups that the file holds, with the directions.
fn held(mesh: &Mesh) -> Vec<String> {
    let axes = |fixed: [bool; 3]| {
        ["x", "y", "z"].into_iter().zip(fixed).filter(|own| own.1).map(|own| own.0).collect::<String>()
    };
    let supports = mesh.notes.supports.iter().filter(|named| named.fixed.contains(&true));
    supports.map(|DeckSupport { group, fixed }| format!("{group} {}", axes(*fixed))).collect()
}

/// A static step before that of the frequencies, which adds a set, begins anew, or both in two boundaries; a step after it.
#[test]
fn boundaries_count_up_to_the_step_of_the_frequencies() {
    let deck = CUBES.split("*STEP").next().unwrap().to_owned()
        + "*BOUNDARY\nmixed,1\n*STEP\n*STATIC\n*BOUNDARY\nFeet,1,3\n*END STEP\n*STEP\n*FREQUENCY\n3\n*BOUNDARY\nsensor,2\n\
            *END STEP\n*STEP\n*FREQUENCY\n3\n*BOUNDARY, OP=NEW\nsensor,3\n*END STEP\n";
    let of = |deck: &str| held(&read(deck.as_bytes()).unwrap());
    assert_eq!(of(&deck), ["Feet xyz", "mixed x", "sensor y"]);
    assert_eq!(of(&deck.replacen("*BOUNDARY\nsensor", "*BOUNDARY, OP=NEW\nsensor", 1)), ["sensor y"]);
    let twice = deck.replacen("*BOUNDARY\nsensor", "*BOUNDARY, OP=NEW\nmixed,3\n*BOUNDARY, OP=NEW\nsensor", 1);
    assert_eq!(of(&twice), ["mixed z", "sensor y"]);
    assert_eq!(of(&deck.replace("*FREQUENCY", "*STATIC")), ["Feet xyz", "mixed x"]);
    let said = |deck: &str| read(deck.as_bytes()).unwrap().notes.not_supports.concat();
    assert_eq!(said(&deck), "the file has 3 steps: *BOUNDARY counts up to step 2, the first that has *FREQUENCY");
    assert!(said(&deck.replace("*FREQUENCY", "*STATIC")).ends_with("up to step 1, as none has *FREQUENCY"));
    // what only a later step names is named still
    let anew = read(deck.replacen("*BOUNDARY\nsensor,2", "*BOUNDARY, OP=NEW", 1).as_bytes()).unwrap();
    let named: Vec<_> = anew.notes.supports.iter().map(|named| named.group.as_str()).collect();
    assert_eq!((named, held(&anew)), (vec!["Feet", "mixed", "sensor"], Vec::new()));
}

/// The cubes with other lines after their sets.
fn with(lines: &str) -> Mesh {
    let deck = CUBES.split("*MATERIAL").next().unwrap().to_owned() + lines;
    read(deck.as_bytes()).unwrap()
}

/// CalculiX refuses all but whole numbers from 1.
#[test]
fn a_direction_is_a_whole_number() {
    for (words, expected) in [("1,2", "Feet xy"), ("2", "Feet y"), ("2,", "Feet y"), ("3,6", "Feet z")] {
        let mesh = with(&format!("*BOUNDARY\nfeet,{words}\n"));
        assert_eq!((held(&mesh), &mesh.notes.not_supports[..]), (vec![expected.to_owned()], &[][..]), "{words}");
    }
    for words in ["1.5,2.7", "1.0,3", "1,2.5", "1,x", "3,1", "0,3", "-1,3"] {
        let mesh = with(&format!("*BOUNDARY\nfeet,{words}\n"));
        let lost = mesh.notes.not_supports.concat();
        assert!(lost.starts_with("*BOUNDARY has lines (1, first line 42) that move nodes"), "{words}: {lost}");
        assert_eq!(held(&mesh), [""; 0], "{words}");
    }
}

/// CalculiX takes the last of such keywords, and Abaqus refuses two.
#[test]
fn what_is_not_isotropic_and_linear_has_no_elastic_constants() {
    let elastic = "*ELASTIC\n2.1e5,.3\n";
    for (first, second, law) in [
        (elastic, "*PLASTIC\n200.,0.\n", None),
        (elastic, "*HYPERELASTIC, NEO HOOKE\n1.,.01\n", Some("*HYPERELASTIC")),
        ("*HYPERFOAM\n1.,2.,.3\n", elastic, Some("*HYPERFOAM")),
        ("*ELASTIC,TYPE=ORTHO\n9.,3.,9.,3.,3.,9.,3.,3.,\n3.\n", "", Some("*ELASTIC, TYPE=ORTHO")),
        ("*ELASTIC, TYPE=Engineering Constants\n9.\n", "", Some("*ELASTIC, TYPE=Engineering Constants")),
    ] {
        let mesh = with(&format!("*MATERIAL,NAME=M\n{first}*DENSITY\n7.8e-9\n{second}"));
        let [own] = &mesh.notes.materials[..] else { panic!("{:?}", mesh.notes) };
        assert_eq!(own.other_law.as_deref(), law);
        assert_eq!(own.elastic, law.is_none().then_some([2.1e5, 0.3]), "{second}");
        assert!(own.density.is_some() && !own.first_line);
    }
}

/// In CalculiX, axes that a step gives turn nodes too.
#[test]
fn axes_turn_the_sets_that_have_their_nodes() {
    let of = |transform: &str| held(&with(&format!("{transform}*BOUNDARY\nfeet,1,2\nsensor,1\n*STEP\n*STATIC\n")));
    let axes = "0,1,0,1,0,0\n";
    assert_eq!(of(&format!("*TRANSFORM, NSET=SENSOR\n{axes}")), ["Feet xy"]);
    // mixed has the nodes of feet
    assert_eq!(of(&format!("*TRANSFORM, NSET=mixed\n{axes}")), ["sensor x"]);
    assert_eq!(of(&format!("*TRANSFORM, NSET=none\n{axes}")), [""; 0]);
    let later = |step: &str| held(&with(&format!("*BOUNDARY\nsensor,1\n{step}*TRANSFORM,NSET=sensor\n{axes}")));
    assert_eq!(later("*STEP\n"), [""; 0]);
    assert_eq!(later("*STEP\n*FREQUENCY\n2\n*END STEP\n*STEP\n"), ["sensor x"]);
    let node = with(&format!("*TRANSFORM,NSET=sensor\n{axes}*BOUNDARY\n7,1\n8,1\n"));
    let lost = &node.notes.not_supports;
    assert!(
        lost[0].contains("single nodes (1, first in line 45)") && lost[1].contains("(1, first line 44)"),
        "{lost:?}"
    );
}

/// A case means the group of the highest dimension by a name, and none of two.
#[test]
fn a_held_set_whose_name_a_surface_has_is_told() {
    let told = "*BOUNDARY holds the set \"NAME\", whose name another set or surface has: name one anew";
    for name in ["sensor", "Feet"] {
        let mesh = with(&format!("*SURFACE, NAME={name}\nupper, S2\n*BOUNDARY\n{name},1,3\n"));
        assert_eq!(mesh.groups.iter().filter(|group| group.name == name).count(), 2);
        assert_eq!(mesh.notes.not_supports, [told.replace("NAME", name)]);
        assert_eq!(held(&mesh), [""; 0]);
        // nor is it guessed
        assert!(mesh.notes.supports.iter().any(|own| own.group == name), "{:?}", mesh.notes);
    }
    // another name to a case, and the same one to the file
    let mesh = with("*SURFACE, NAME=SENSOR\nupper, S2\n*BOUNDARY\nsensor,1,3\n");
    assert_eq!(held(&mesh), ["sensor xyz"]);
    // a set of the assembly, and one of the part by the same name: one of the two has faces
    for (of_part, of_assembly, expected) in [("5", "1, 3, 4", "bore x"), ("1, 3, 4", "5", "bore y")] {
        let cae = super::CAE
            .replace("*Nset, nset=Set-1", &format!("*Nset, nset=bore\n{of_part}\n*Nset, nset=Set-1"))
            .replace("instance=Block-1\n 1, 3, 4", &format!("instance=Block-1\n {of_assembly}"))
            .replace("*Step", "*Boundary\nbore,1\nBlock-1.bore,2\n*Step");
        let mesh = read(cae.as_bytes()).unwrap();
        assert_eq!(held(&mesh), [expected]);
        assert_eq!(mesh.notes.not_supports, [told.replace("NAME", "bore")]);
    }
}

#[test]
fn sections_and_materials_that_name_nothing_are_told_by_line() {
    let of = |lines: &str| super::told(&with(lines)).concat();
    let steel = "*MATERIAL,NAME=Steel\n*ELASTIC\n2.1e5,.3\n";
    assert_eq!(of(&format!("{steel}*SOLID SECTION,ELSET=both,MATERIAL=steel\n")), "");
    for (section, place) in [
        ("ELSET=both,MATERIAL=stel", "1, first line 44, MATERIAL=\"stel\""),
        ("ELSET=both", "1, first line 44, MATERIAL=nothing"),
        ("ELSET=bth,MATERIAL=steel", "1, first line 44, ELSET=\"bth\""),
    ] {
        let expected = format!(
            "*SOLID SECTION names what the file does not have ({place}): give it a *MATERIAL and an *ELSET of the file"
        );
        assert_eq!(of(&format!("{steel}*SOLID SECTION,{section}\n")), expected);
    }
    let nameless = with("*MATERIAL\n*ELASTIC\n2.1e5,.3\n");
    assert_eq!(super::told(&nameless), ["*MATERIAL has no NAME (1, first line 41) and is not taken: give it NAME=..."]);
    assert!(nameless.notes.materials.is_empty());
}
