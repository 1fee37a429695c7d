//! A report with the mode shapes of a structure in space.
//!
//! Reference: none outside; what is written into the data is looked for in the file.
//! Goal: one file, complete in itself, with pictures for print and data for the browser, names as text, tables as CSV,
//!   and below 15 MB for a surface of 200 000 triangles with 20 modes.
//! Sketch: a cube of squares, cut into triangles, in two groups; smooth displacements that vanish at its bottom.
//! Conditions: no browser is needed.
//! Parameters: squares an edge, modes.

use std::fs;

use plummer::report::{
    Axis, Bars, Cell, Column, Document, Matrix, ModeShapeView, Report, Section, ShapeFigures, ShapeGroup, ShapeLine,
    ShapeMode, ShapeTriangle, Table, Verdict,
};

/// A cube with sides of 0.1 m; every face has points of its own.
fn cube(squares: usize, modes: usize) -> ModeShapeView {
    let mut view = ModeShapeView::new("Cube");
    view.groups = ["sides </script><b>bold</b>", "top"]
        .iter()
        .enumerate()
        .map(|(colour, name)| ShapeGroup { name: (*name).to_owned(), colour })
        .collect();
    let at = |k: usize| 0.1 * k as f64 / squares as f64;
    for (axis, end) in (0..3).flat_map(|axis| [(axis, 0), (axis, squares)]) {
        let first = view.points.len();
        for i in 0..=squares {
            for j in 0..=squares {
                let mut point = [at(end); 3];
                point[(axis + 1) % 3] = at(i);
                point[(axis + 2) % 3] = at(j);
                view.points.push(point);
            }
        }
        let group = usize::from(axis == 2 && end > 0);
        for (i, j) in (0..squares).flat_map(|i| (0..squares).map(move |j| (i, j))) {
            let a = first + i * (squares + 1) + j;
            let b = a + squares + 1;
            for corners in [[a, b, b + 1], [a, b + 1, a + 1]] {
                view.triangles.push(ShapeTriangle { corners, group });
            }
            view.edges.extend([[a, b], [a, a + 1]]);
        }
    }
    let top = view.points.len() - (squares + 1).pow(2);
    view.lines.push(ShapeLine {
        name: "rim".to_owned(),
        points: vec![top, top + squares, view.points.len() - 1, view.points.len() - 1 - squares],
        closed: true,
    });
    for mode in 1..=modes {
        let wave = 9.0 * mode as f64;
        let displacement = view
            .points
            .iter()
            .map(|&[x, y, z]| [z * (wave * y).cos(), z * (wave * x).sin(), z * (wave * (x + y)).sin()]);
        view.modes.push(ShapeMode {
            label: mode.to_string(),
            frequency_hz: 123.4 * mode as f64,
            note: format!("note <{mode}>"),
            displacement: displacement.collect(),
        });
    }
    view
}

fn report(view: ModeShapeView) -> Report {
    let expected = Table::new(
        "Expected and found",
        [Column::text("Mode"), Column::number("Found", "Hz"), Column::text("Verdict")],
    )
    .row([Cell::text("1"), Cell::number(123.456_789, 4), Cell::badge(Verdict::Ok)])
    .row([Cell::text("2"), Cell::number(246.8, 4), Cell::badge(Verdict::Bad)])
    .showing_modes([Some(0), Some(1)]);
    let labels: Vec<String> = vec!["1".into(), "2".into()];
    let masses =
        Bars::new("Effective mass", "Mode", labels.clone(), Axis::new("Mass", "kg")).series("x", vec![1.0, 0.25]);
    let criterion =
        Matrix::new("MAC", ("Found", labels.clone()), ("Expected", labels), vec![vec![0.99, 0.01], vec![0.02, 0.98]]);
    Report::new("Cube", "plummer modes cube.toml", "0.1.0")
        .date("21 November 2026")
        .document(
            Document::new()
                .case("cube.toml")
                .mesh("cube.msh", Some("SHA-256 00ff".to_owned()))
                .signed_by("Prepared by")
                .signed_by("Checked by"),
        )
        .judgement("Verification", "1 of 2 within limits", Verdict::Bad)
        .section(Section::new("Frequencies").table(expected).bars(masses))
        .section(Section::new("Shapes").shapes(view).matrix(criterion))
}

#[test]
fn a_cube_with_modes_is_one_whole_file() {
    let html = report(cube(6, 4)).to_html().expect("a valid report");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("report.html");
    fs::write(&path, &html).expect("written");
    assert_eq!(fs::read_to_string(&path).expect("read"), html);
    for text in [
        "<b>Figure 1.</b> Effective mass",
        "<b>Figure 2.</b> Cube: mesh and groups.",
        "<b>Figure 3.</b> Cube: mode shapes.",
        "<b>Figure 4.</b> MAC",
        "<div class=\"cell\"><svg class=\"shape\"",
        "<b>Mode 4 · 493.6000 Hz</b><br>note &lt;4&gt;",
        "<span class=\"frequency\">493.6000 Hz</span>",
        "<tr data-mode=\"1\">",
        "<span class=\"badge ok\">pass</span>",
        "<span class=\"badge bad\">fail</span>",
        "download=\"table-1-expected-and-found.csv\"",
        "<p class=\"judgement bad\">",
        "SHA-256 00ff",
        "<div><span>Checked by</span><span>Date</span></div>",
        "counter(page)",
        "<script type=\"text/plain\" id=\"three\">",
        "Permission is hereby granted, free of charge",
    ] {
        assert!(html.contains(text), "{text}");
    }
    // Four modes, each in its own picture; all in the list.
    assert_eq!(html.matches("<div class=\"cell\">").count(), 4);
    assert_eq!(html.matches("type=\"radio\"").count(), 4);
}

#[test]
fn names_are_text_wherever_they_stand() {
    let html = report(cube(2, 2)).to_html().expect("a valid report");
    assert!(!html.contains("<b>bold") && !html.contains("note <1>"));
    assert!(html.contains("sides &lt;&#x2f;script&gt;&lt;b&gt;bold"));
    // Scripts that end are those that the page begins.
    let (begun, ended) = (html.matches("<script").count(), html.matches("</script").count());
    assert_eq!((begun, ended), (3, 3));
}

#[test]
fn nothing_is_fetched_and_nothing_is_evaluated() {
    let html = report(cube(2, 2)).to_html().expect("a valid report");
    for outside in
        [" src=", "<link", "@import", "url(http", "href=\"http", "fetch(", "XMLHttpRequest", "eval(", "new Function"]
    {
        assert!(!html.contains(outside), "{outside}");
    }
}

#[test]
fn a_large_surface_stays_below_fifteen_megabytes() {
    // 6 x 130² squares of two triangles
    let view = cube(130, 20);
    assert_eq!(view.triangles.len(), 202_800);
    let html = report(view).to_html().expect("a valid report");
    assert!(html.len() < 15_000_000, "{} bytes", html.len());
    // The budget is used: a file much smaller would have left out what there is room for.
    assert!(html.len() > 5_000_000, "{} bytes", html.len());
}

#[test]
fn without_modes_there_is_a_picture_and_no_library() {
    let html = report(cube(3, 0)).to_html().expect("a valid report");
    assert!(html.contains("Cube: mesh and groups.") && !html.contains("id=\"three\""));
    let mut still = cube(3, 2);
    still.figures = ShapeFigures::Mesh;
    let html = report(still).to_html().expect("a valid report");
    assert!(!html.contains("mode shapes.") && !html.contains("id=\"three\""));
}

#[test]
fn a_view_that_does_not_fit_together_is_an_error() {
    let mut view = cube(2, 1);
    view.modes[0].displacement.pop();
    let error = report(view).to_html().expect_err("must fail");
    assert_eq!(error.to_string(), "shape \"Cube\": mode \"1\" has 53 displacements for 54 points");
}
