//! Clearance of bearings as they are sold.

/// Bore above which, bore up to which (mm), smallest and largest clearance (µm): group N (C0). GMN, catalogue 4000 0813 EN (2013),
/// pp. 48-49, up to 40 mm; Timken, Deep groove ball bearing catalog, order no. 10857 (2017), table 5, which agrees with it, above.
const GROUP_N: [(f64, f64, f64, f64); 7] = [
    (1.5, 6.0, 2.0, 13.0),
    (6.0, 10.0, 2.0, 13.0),
    (10.0, 18.0, 3.0, 18.0),
    (18.0, 24.0, 5.0, 20.0),
    (24.0, 30.0, 5.0, 20.0),
    (30.0, 40.0, 6.0, 20.0),
    (40.0, 50.0, 6.0, 23.0),
];

/// Smallest and largest diametral clearance (m) of a new bearing of group N that is not mounted, for a bore in m; `None` outside
/// the table, 1.5 to 50 mm. Interference fits take part of it away, and so does a warm inner ring.
#[must_use]
pub fn normal_clearance(bore: f64) -> Option<[f64; 2]> {
    // bores of the table are whole millimetres: rounding must not put one into the next row
    let bore = 1e3 * bore - 1e-6;
    let row = GROUP_N.iter().find(|&&(above, up_to, ..)| bore > above && bore <= up_to);
    row.map(|&(_, _, least, most)| [1e-6 * least, 1e-6 * most])
}
