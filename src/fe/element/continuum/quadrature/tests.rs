use super::*;

/// `int xi^i eta^j zeta^k` over the natural triangle (k = 0) or tetrahedron:
/// `i! j! k! / (i + j + k + dimension)!`.
fn simplex_moment([i, j, k]: [i32; 3], dimension: i32) -> f64 {
    let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
    factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + dimension)
}

/// `int x^i` over [-1, 1].
fn line_moment(i: i32) -> f64 {
    if i % 2 == 0 { 2.0 / f64::from(i + 1) } else { 0.0 }
}

fn error(points: &[QuadraturePoint], powers: [i32; 3], exact: f64) -> f64 {
    let term = |p: &QuadraturePoint| {
        let [x, y, z] = p.natural;
        p.weight * x.powi(powers[0]) * y.powi(powers[1]) * z.powi(powers[2])
    };
    (points.iter().map(term).sum::<f64>() - exact).abs()
}

/// Powers with a given sum, in the first `dimension` directions.
fn powers(total: i32, dimension: i32) -> Vec<[i32; 3]> {
    let mut found = Vec::new();
    for i in 0..=total {
        for j in 0..=(total - i) {
            let k = total - i - j;
            if dimension == 3 || k == 0 {
                found.push([i, j, k]);
            }
        }
    }
    found
}

/// The weights of the computed rules are rounded to 1e-15 of the largest moment, 1/2 or 1/6.
#[test]
fn simplex_rules_are_exact_to_their_degree_and_no_further() {
    let rules = [
        (QuadratureRule::Triangle1.points().to_vec(), 2, 1, 1),
        (QuadratureRule::Triangle3.points().to_vec(), 2, 2, 3),
        (QuadratureRule::Triangle6.points().to_vec(), 2, 4, 6),
        (QuadratureRule::Triangle12.points().to_vec(), 2, 6, 12),
        (conical_triangle(5), 2, 9, 25),
        (conical_tetrahedron(2), 3, 3, 8),
        (QuadratureRule::Tetrahedron1.points().to_vec(), 3, 1, 1),
        (QuadratureRule::Tetrahedron4.points().to_vec(), 3, 2, 4),
        (QuadratureRule::Tetrahedron14.points().to_vec(), 3, 5, 14),
        (QuadratureRule::Tetrahedron24.points().to_vec(), 3, 6, 24),
        (conical_tetrahedron(3), 3, 5, 27),
        (QuadratureRule::Tetrahedron64.points().to_vec(), 3, 7, 64),
    ];
    for (points, dimension, degree, count) in rules {
        assert_eq!(points.len(), count);
        let worst = |total: i32| {
            let errors = powers(total, dimension).into_iter().map(|p| error(&points, p, simplex_moment(p, dimension)));
            errors.fold(0.0, f64::max)
        };
        for total in 0..=degree {
            let found = worst(total);
            assert!(found < 1e-15, "{count} points, degree {total}: {found:e}");
        }
        // high moments are small themselves: relative to the largest one, xi^(degree + 1)
        let scale = simplex_moment([degree + 1, 0, 0], dimension);
        let found = worst(degree + 1) / scale;
        assert!(found > 1e-5, "{count} points: {found:e}");
    }
}

#[test]
fn product_rules_are_exact_to_their_degree_and_no_further() {
    let rules = [
        (QuadratureRule::Line4, 1, 7),
        (QuadratureRule::Square2, 2, 3),
        (QuadratureRule::Square3, 2, 5),
        (QuadratureRule::Square4, 2, 7),
        (QuadratureRule::Cube2, 3, 3),
        (QuadratureRule::Cube3, 3, 5),
        (QuadratureRule::Cube4, 3, 7),
        (QuadratureRule::Cube5, 3, 9),
    ];
    for (rule, dimension, degree) in rules {
        let moment = |p: [i32; 3]| {
            let line = |d: i32| line_moment(p[d as usize]);
            (0..dimension).map(line).product::<f64>()
        };
        let limit = |d: i32| if d < dimension { degree } else { 0 };
        for i in 0..=limit(0) {
            for j in 0..=limit(1) {
                for k in 0..=limit(2) {
                    let found = error(rule.points(), [i, j, k], moment([i, j, k]));
                    assert!(found < 1e-14, "{rule:?} ({i}, {j}, {k}): {found:e}");
                }
            }
        }
        let beyond = [degree + 1, 0, 0];
        let found = error(rule.points(), beyond, moment(beyond));
        assert!(found > 1e-3, "{rule:?}: {found:e}");
    }
}

#[test]
fn wedge_rules_are_exact_to_their_degrees() {
    let rules = [
        (QuadratureRule::Wedge3x2, 2, 3),
        (QuadratureRule::Wedge6x3, 4, 5),
        (QuadratureRule::Wedge12x4, 6, 7),
        (QuadratureRule::Wedge25x5, 9, 9),
    ];
    for (rule, triangle, line) in rules {
        for total in 0..=triangle {
            for [i, j, _] in powers(total, 2) {
                for k in 0..=line {
                    let exact = simplex_moment([i, j, 0], 2) * line_moment(k);
                    let found = error(rule.points(), [i, j, k], exact);
                    assert!(found < 1e-14, "{rule:?} ({i}, {j}, {k}): {found:e}");
                }
            }
        }
    }
}

/// In `xi = x / (1 - z)`, `eta` and z, with `int (1 - z)^2 z^k dz = 2 k! / (k + 3)!`.
#[test]
fn pyramid_rules_are_exact_to_their_degrees_and_no_further() {
    let rules = [
        (QuadratureRule::Pyramid2x1, 3, 1),
        (QuadratureRule::Pyramid2x2, 3, 3),
        (QuadratureRule::Pyramid3x2, 5, 3),
        (QuadratureRule::Pyramid3x3, 5, 5),
        (QuadratureRule::Pyramid5x4, 9, 7),
    ];
    for (rule, across, along) in rules {
        let points: Vec<QuadraturePoint> = rule
            .points()
            .iter()
            .map(|&QuadraturePoint { natural: [x, y, z], weight }| point([x / (1.0 - z), y / (1.0 - z), z], weight))
            .collect();
        let off = |[i, j, k]: [i32; 3]| {
            let exact = line_moment(i) * line_moment(j) * 2.0 * simplex_moment([k, 0, 0], 3);
            error(&points, [i, j, k], exact)
        };
        for i in 0..=across {
            for j in 0..=across {
                for k in 0..=along {
                    let found = off([i, j, k]);
                    assert!(found < 1e-14, "{rule:?} ({i}, {j}, {k}): {found:e}");
                }
            }
        }
        assert!(off([across + 1, 0, 0]) > 1e-4 && off([0, 0, along + 1]) > 1e-6, "{rule:?}");
    }
}

/// No point on the boundary or outside, no negative weight: a valid element stays valid.
#[test]
fn points_are_inside_and_weights_positive() {
    for points in [
        QuadratureRule::Tetrahedron14.points(),
        QuadratureRule::Tetrahedron24.points(),
        QuadratureRule::Tetrahedron64.points(),
        QuadratureRule::Wedge25x5.points(),
    ] {
        for p in points {
            assert!(p.weight > 0.0 && p.natural[0] > 0.0 && p.natural[1] > 0.0);
            assert!(p.natural[0] + p.natural[1] + p.natural[2].min(0.0) < 1.0);
        }
    }
}
