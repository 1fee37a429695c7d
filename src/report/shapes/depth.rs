//! What of a projected surface can be seen: a depth buffer.

/// A point of the picture: right and down in pixels, and nearness to the viewer in any unit.
pub(super) type Spot = [f64; 3];

/// Samples a pixel, along each edge.
const FINE: f64 = 2.0;

/// The nearest triangle in each sample of a picture.
#[derive(Debug)]
pub(super) struct DepthBuffer {
    width: usize,
    height: usize,
    nearest: Vec<f64>,
    triangle: Vec<Option<usize>>,
}

impl DepthBuffer {
    /// The buffer of a picture of `width` x `height` pixels with these triangles in it.
    pub(super) fn of(size: [f64; 2], spots: &[Spot], triangles: &[[usize; 3]]) -> Self {
        let samples = |pixels: f64| (pixels * FINE).ceil().clamp(1.0, 8192.0) as usize;
        let (width, height) = (samples(size[0]), samples(size[1]));
        let mut buffer = Self {
            width,
            height,
            nearest: vec![f64::NEG_INFINITY; width * height],
            triangle: vec![None; width * height],
        };
        for (number, corners) in triangles.iter().enumerate() {
            buffer.fill(number, corners.map(|k| spots[k]));
        }
        buffer
    }

    fn fill(&mut self, number: usize, corners: [Spot; 3]) {
        let [a, b, c] = corners.map(|[x, y, z]| [x * FINE - 0.5, y * FINE - 0.5, z]);
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if twice.abs() <= 1e-12 || !twice.is_finite() {
            return;
        }
        let range = |k: usize, end: usize| {
            let low = a[k].min(b[k]).min(c[k]).ceil().max(0.0) as usize;
            let high = a[k].max(b[k]).max(c[k]).floor().min(end as f64 - 1.0);
            low..(high + 1.0).max(0.0) as usize
        };
        for y in range(1, self.height) {
            for x in range(0, self.width) {
                let (px, py) = (x as f64, y as f64);
                let part = |p: Spot, q: Spot| ((p[0] - px) * (q[1] - py) - (q[0] - px) * (p[1] - py)) / twice;
                let parts = [part(b, c), part(c, a), part(a, b)];
                // A sample on a common edge belongs to both.
                if parts.iter().any(|p| *p < -1e-9) {
                    continue;
                }
                let near = parts[0] * a[2] + parts[1] * b[2] + parts[2] * c[2];
                let place = y * self.width + x;
                if near > self.nearest[place] {
                    self.nearest[place] = near;
                    self.triangle[place] = Some(number);
                }
            }
        }
    }

    /// For each of `count` triangles whether any of it can be seen.
    pub(super) fn seen(&self, count: usize) -> Vec<bool> {
        let mut seen = vec![false; count];
        for number in self.triangle.iter().flatten() {
            seen[*number] = true;
        }
        seen
    }

    /// Whether a point stands in front of the surface or on it, to `slack` in nearness: the farthest of the samples
    /// round it decides, such that a point on a rim counts as seen.
    pub(super) fn shows(&self, [x, y, z]: Spot, slack: f64) -> bool {
        let (column, row) = ((x * FINE) as i64, (y * FINE) as i64);
        (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (column + dx, row + dy))).any(|(column, row)| {
            let inside = (0..self.width as i64).contains(&column) && (0..self.height as i64).contains(&row);
            !inside || z + slack >= self.nearest[row as usize * self.width + column as usize]
        })
    }

    /// The parts of a line that can be seen.
    pub(super) fn visible_parts(&self, from: Spot, to: Spot, slack: f64) -> Vec<[Spot; 2]> {
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let steps = (length / 1.5).ceil().clamp(1.0, 2000.0) as usize;
        let at = |k: usize| -> Spot {
            let part = k as f64 / steps as f64;
            std::array::from_fn(|i| from[i] + part * (to[i] - from[i]))
        };
        let shown: Vec<bool> = (0..steps)
            .map(|k| {
                let (a, b) = (at(k), at(k + 1));
                self.shows(std::array::from_fn(|i| 0.5 * (a[i] + b[i])), slack)
            })
            .collect();
        let (mut parts, mut first) = (Vec::new(), 0);
        for run in shown.chunk_by(|a, b| a == b) {
            let end = first + run.len();
            // The end of a hidden edge shows at a corner in front: too short to be an edge.
            let stub = run.len() < 3 && 2 * run.len() < steps;
            if run[0] && !stub {
                parts.push([at(first), at(end)]);
            }
            first = end;
        }
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A far square and a near one over its right half.
    fn two_squares() -> (Vec<Spot>, Vec<[usize; 3]>) {
        let square = |left: f64, z: f64| [[left, 10.0, z], [50.0, 10.0, z], [50.0, 50.0, z], [left, 50.0, z]];
        let spots = [square(10.0, 0.0), square(30.0, 5.0), square(35.0, 1.0)].concat();
        let corners = [0, 4, 8].map(|k| [[k, k + 1, k + 2], [k, k + 2, k + 3]]);
        (spots, corners.concat())
    }

    #[test]
    fn what_is_covered_is_not_seen() {
        let (spots, triangles) = two_squares();
        let buffer = DepthBuffer::of([60.0, 60.0], &spots, &triangles);
        assert_eq!(buffer.seen(6), [true, true, true, true, false, false]);
    }

    #[test]
    fn lines_end_where_they_go_behind() {
        let (spots, triangles) = two_squares();
        let buffer = DepthBuffer::of([60.0, 60.0], &spots, &triangles);
        let parts = buffer.visible_parts([0.0, 20.0, 0.0], [60.0, 20.0, 0.0], 0.1);
        assert_eq!(parts.len(), 2, "{parts:?}");
        // A step is 1.5 pixels, and a sample is half a pixel.
        assert!((parts[0][1][0] - 30.0).abs() < 2.0, "{parts:?}");
        assert!((parts[1][0][0] - 50.0).abs() < 2.0, "{parts:?}");
        let front = buffer.visible_parts([0.0, 20.0, 5.0], [60.0, 20.0, 5.0], 0.1);
        assert_eq!(front.len(), 1);
    }
}
