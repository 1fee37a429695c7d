#!/bin/sh
# Figures 9 to 16 of Tadina & Boltezar (2011) by four cases, into docs/figures/paper, and those of the transfer path's tutorial, into
# docs/figures/path; `make figures` calls it.
#   PLUMMER=path/to/plummer sh scripts/figures.sh
set -eu
cd "$(dirname "$0")/.."
plummer=${PLUMMER:-target/release/plummer}
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
