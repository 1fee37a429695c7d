//! Colours of plots, charts and shapes, the same in the pictures and in the browser.

/// Red, green and blue, 0 to 255.
pub(super) type Rgb = [u8; 3];

/// Viridis at k / 15: perceptually uniform, readable in grey and by the colour-blind (S. van der Walt, N. Smith,
/// matplotlib 1.5, 2015, public domain).
pub(super) const VIRIDIS: [Rgb; 16] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x1a, 0x6c],
    [0x47, 0x2f, 0x7d],
    [0x41, 0x44, 0x87],
    [0x39, 0x56, 0x8c],
    [0x31, 0x68, 0x8e],
    [0x2a, 0x78, 0x8e],
    [0x23, 0x88, 0x8e],
    [0x1f, 0x98, 0x8b],
    [0x22, 0xa8, 0x84],
    [0x35, 0xb7, 0x79],
    [0x54, 0xc5, 0x68],
    [0x7a, 0xd1, 0x51],
    [0xa5, 0xdb, 0x36],
    [0xd2, 0xe2, 0x1b],
    [0xfd, 0xe7, 0x25],
];

/// White to dark blue, by even steps of lightness.
const BLUES: [Rgb; 5] = [[255, 255, 255], [206, 221, 236], [142, 178, 212], [75, 125, 175], [20, 61, 110]];

/// Colours of curves, bars and markers as the style sheet has them on white; the next one begins again.
pub(super) const SERIES: [&str; 6] = ["#1f5a99", "#c8511b", "#2e7d4f", "#7b4ea3", "#8c6d1f", "#4d5761"];

/// How many colours curves, bars and markers have.
pub(super) const COLOURS: usize = SERIES.len();

/// Colours of groups: muted, of similar lightness, told apart in print.
const GROUPS: [Rgb; 10] = [
    [0x8f, 0xae, 0xcb],
    [0xe0, 0xa0, 0x6c],
    [0x9b, 0xbf, 0x8f],
    [0xc9, 0x94, 0xb5],
    [0xd6, 0xc1, 0x6b],
    [0x7f, 0xbf, 0xc0],
    [0xd9, 0x8a, 0x86],
    [0xa9, 0x9f, 0xd1],
    [0xb0, 0xa0, 0x8c],
    [0xb4, 0xbb, 0xc2],
];

/// Colour of thick lines.
pub(super) const LINE: Rgb = [0xc8, 0x3a, 0x1b];

/// Colour of a group.
pub(super) fn group(index: usize) -> Rgb {
    GROUPS[index % GROUPS.len()]
}

/// The colour at a part of a scale, 0 to 1, straight between its `N` supports, two at least; `at` is taken to 0..1.
fn between<const N: usize>(scale: [Rgb; N], at: f64) -> Rgb {
    let place = at.clamp(0.0, 1.0) * (N - 1) as f64;
    let low = (place.floor() as usize).min(N - 2);
    let part = place - low as f64;
    let (a, b) = (scale[low], scale[low + 1]);
    std::array::from_fn(|k| (f64::from(a[k]) * (1.0 - part) + f64::from(b[k]) * part).round() as u8)
}

/// Viridis between its supports; `at` is taken to 0..1.
pub(super) fn viridis(at: f64) -> Rgb {
    between(VIRIDIS, at)
}

/// White to dark blue; `at` is taken to 0..1.
pub(super) fn blues(at: f64) -> Rgb {
    between(BLUES, at)
}

/// A colour made darker: 1 leaves it, 0 makes it black.
pub(super) fn shaded(colour: Rgb, light: f64) -> Rgb {
    colour.map(|c| (f64::from(c) * light.clamp(0.0, 1.0)).round() as u8)
}

/// As CSS writes it.
pub(super) fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_map_gets_lighter_all_the_way() {
        // Relative luminance, ITU-R BT.709; the map is also right when printed in grey.
        let luminance = |[r, g, b]: Rgb| {
            let linear = |c: u8| (f64::from(c) / 255.0).powf(2.2);
            0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b)
        };
        let steps: Vec<f64> = (0..=60).map(|k| luminance(viridis(f64::from(k) / 60.0))).collect();
        assert!(steps.windows(2).all(|w| w[1] > w[0]), "{steps:?}");
        assert_eq!(hex(viridis(-1.0)), "#440154");
        assert_eq!(hex(viridis(2.0)), "#fde725");
        assert_eq!(hex(viridis(7.0 / 15.0)), "#23888e");
    }

    #[test]
    fn shading_darkens_and_groups_begin_again() {
        assert_eq!(shaded([200, 100, 50], 0.5), [100, 50, 25]);
        assert_eq!(group(0), group(10));
        assert_ne!(group(0), group(1));
    }
}
