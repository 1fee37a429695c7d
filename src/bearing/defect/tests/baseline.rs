use super::*;
#[test]
fn baseline_dump() {
    let mut out = String::new();
    let mut all: Vec<Dent> = subjects()[..5]
        .iter()
        .map(|(_, s)| match s {
            Subject::Race(RaceDefect::Dent(d)) => d.clone(),
            _ => panic!(),
        })
        .collect();
    all.push(solved(
        Race::Outer,
        DentShape {
            curvature: CurvatureReading::Paper,
            ..source_shape(Race::Outer)
        },
    ));
    let text = std::fs::read_to_string("/tmp/baseline_old.txt").unwrap();
    let half: Vec<f64> = text
        .lines()
        .filter(|l| l.split(' ').count() == 2)
        .map(|l| l.split(' ').next().unwrap().parse().unwrap())
        .collect();
    for (dent, half) in all.iter().zip(half) {
        out += &format!("{:e} {:e}\n", dent.contact_half_angle(), dent.drop());
        for i in 0..4000 {
            let sunk = -2e-6 + 30e-6 * f64::from(i % 37) / 36.0;
            let offset = half * (f64::from(i) / 2000.0 - 1.0) * 1.2;
            let place = PolarPosition {
                radius: 4.7565e-3 - 1e-3 + sunk,
                angle: MIDDLE + offset,
            };
            for c in dent.contacts(place).as_slice() {
                out += &format!(
                    "{i} {:?} {:e} {:e} {:e} {:e}\n",
                    c.feature, c.delta, c.normal_radial, c.normal_tangential, c.stiffness
                );
            }
        }
    }
    std::fs::write("/tmp/baseline_new.txt", out).unwrap();
}
