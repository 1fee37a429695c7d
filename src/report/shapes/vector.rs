//! Vectors in space.

/// A vector in space.
pub(super) type Vector = [f64; 3];

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The vector of length 1, or as it is if it has none.
pub(super) fn unit(a: Vector) -> Vector {
    let length = magnitude(&a);
    if length > 0.0 { a.map(|v| v / length) } else { a }
}

/// The length of a vector.
pub(super) fn magnitude(d: &Vector) -> f64 {
    dot(*d, *d).sqrt()
}

/// Lowest and highest coordinates; zero without points.
pub(super) fn bounds(points: &[Vector]) -> (Vector, Vector) {
    let Some(first) = points.first() else {
        return ([0.0; 3], [0.0; 3]);
    };
    points.iter().fold((*first, *first), |(low, high), p| {
        (std::array::from_fn(|k| low[k].min(p[k])), std::array::from_fn(|k| high[k].max(p[k])))
    })
}

/// Diagonal of the box round the points; zero without points.
pub(super) fn diagonal(points: &[Vector]) -> f64 {
    let (low, high) = bounds(points);
    magnitude(&minus(high, low))
}
