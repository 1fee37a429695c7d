#!/bin/sh
# Figures of the documents, into docs/figures: those of Tadina & Boltezar (2011), 9 to 16, by four cases, into paper; of the tutorials, into
# path and run-up; and the picture of a report in README (which needs Chromium). `make figures` calls it.
#   PLUMMER=path/to/plummer sh scripts/figures.sh [paper] [path] [run-up] [report] [verification]
set -eu
cd "$(dirname "$0")/.."
plummer=${PLUMMER:-$(sh scripts/target.sh)/release/plummer}

paper() {
    out=out/paper
    to=docs/figures/paper
    mkdir -p "$to"
    for case in healthy outer-dent inner-dent ball-flat; do
        # the paper's windows: 0.1 s from 2.3 s on, 0.15 s for the ball; what the run begins with has died away by 2.2 s
        end=2.4
        [ "$case" = ball-flat ] && end=2.45
        "$plummer" run "examples/tadina2011/$case.toml" --out "$out/$case" --force \
            --set transient.start=2.0 --set transient.end=2.82 \
            --set "analysis.envelope=[{from=2.3,to=$end},{from=2.2,to=2.8}]" \
            --set "analysis.scalogram={from=2.2,to=2.5,band_hz=[500,40000]}"
        from="$out/$case/figures"
        cp "$from"/run-*-acceleration-at-p1.svg "$to/$case-signal.svg"
        cp "$from"/run-*-envelope-spectrum-of-p1-2-300-*.svg "$to/$case-envelope.svg"
        cp "$from"/run-*-scalogram-of-p1-*.svg "$to/$case-scalogram.svg"
        # the same window of the whitened signal's squared envelope
        "$plummer" analyze "$out/$case" --window "2.3:$end" --whiten --out "$out/$case/whitened" --force || test $? = 1
        cp "$out/$case"/whitened/figures/analysis-*-squared-envelope-spectrum-*.svg "$to/$case-whitened.svg"
    done
}

path() {
    to=docs/figures/path
    mkdir -p "$to"
    for housing in ring pillow_block end_shield; do
        "$plummer" frf "examples/housings/$housing.toml" --out "out/path/$housing-frf" --force \
            --set 'frf={from=[{ring_deg=270,direction=[0,-1,0]}],to=["P1"],band_hz=[100,50000]}'
        "$plummer" run "examples/housings/$housing.toml" --out "out/path/$housing" --force
        cp "out/path/$housing-frf"/figures/frf-*-accelerance-magnitude.svg "$to/$housing-path.svg"
        cp "out/path/$housing"/figures/run-*-p1-and-its-envelope.svg "$to/$housing-signal.svg"
        cp "out/path/$housing"/figures/run-*-envelope-spectrum-of-p1-*.svg "$to/$housing-envelope.svg"
    done
}

# As docs/tutorials/run-up.md has them.
run_up() {
    out=out/run-up
    to=docs/figures/run-up
    mkdir -p "$to"
    "$plummer" run examples/tadina2011/outer-dent.toml --out $out/outer --force
    "$plummer" analyze $out/outer --window 1.0:2.6 --out $out/outer-verdict --force
    "$plummer" run examples/tadina2011/outer-dent.toml --out $out/inner --force \
        --set 'bearing.defects=[{on="inner", angle_deg=0, length=0.8e-3, depth=0.015e-3}]' \
        --set transient.end=3.0 --set 'analysis.envelope=[{from=1.5, to=3.0}]'
    "$plummer" analyze $out/inner --out $out/inner-verdict --force
    cp $out/outer/figures/run-*-acceleration-at-p1.svg "$to/signal.svg"
    cp $out/outer-verdict/figures/analysis-1-*.svg "$to/outer-orders.svg"
    cp $out/inner-verdict/figures/analysis-1-*.svg "$to/inner-orders.svg"
}

# The upper part of the first run's verdict.
report() {
    run_up
    for browser in chromium chromium-browser google-chrome; do
        command -v $browser >/dev/null 2>&1 || continue
        $browser --headless --no-sandbox --hide-scrollbars --window-size=1060,1180 \
            --screenshot="$PWD/docs/figures/report.png" "file://$PWD/out/run-up/outer-verdict/report.html"
        return
    done
    echo "no Chromium: docs/figures/report.png is left as it is" >&2
}

# The program's verification report, which the book has as a page of its own.
verification() {
    "$plummer" verify --out out/verification --force
    cp out/verification/report.html docs/verification-report.html
}

[ $# -gt 0 ] || set -- paper path report verification
for what in "$@"; do
    case "$what" in
        paper) paper ;;
        path) path ;;
        run-up) run_up ;;
        report) report ;;
        verification) verification ;;
        *) echo "no such figures: $what (paper, path, run-up, report, verification)" >&2; exit 2 ;;
    esac
done
