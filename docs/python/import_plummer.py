import numpy as np
import plummer

case = plummer.Case.load("examples/tadina2011/outer-dent.toml")
case.update({"transient.end": 1.8, "analysis.envelope": [{"from": 1.0, "to": 1.8}]})
case["bearing.defects.0.depth"] = 2e-5
modes = case.modes()
print(f"{modes.count} modes, the first elastic one at {modes.frequencies_hz[modes.rigid]:.0f} Hz")

run = case.run(progress=True)
signal = run["P1"]
print(f"{signal.name}: {np.sqrt(np.mean(signal.values**2)):.1f} {signal.unit} rms; {run.verdicts[0].indicated}")

print(plummer.analyze(signal, bearing=case, windows_s=[(1.0, 1.8)]))
