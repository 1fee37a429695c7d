"""A rigid rotor in Exudyn on one centre node of the condensed housing of plummer: frequencies, and its motion after a knock.

    plummer condense examples/housings/rotor_frame.toml --out out/frame
    python3 docs/python/multibody_exudyn.py out/frame                      # needs numpy, scipy, exudyn 1.13

The superelement is an ObjectGenericODE2: a rigid-body node for each centre node, and one node for the amplitudes of modes. So
every marker, joint and spring of Exudyn takes the centre nodes as those of rigid bodies. Beside it stands SciPy on the same matrices.
"""

import sys

import exudyn
import numpy as np
import scipy
import scipy.linalg
from exudyn.utilities import (
    InertiaCylinder,
    MarkerBodyRigid,
    MarkerNodeRigid,
    NodeGenericODE2,
    NodeRigidBodyRxyz,
    ObjectGenericODE2,
    ObjectRigidBody,
    RigidBodySpringDamper,
    SensorNode,
)

WITHIN = 1e-6  # of frequencies, relative, and of the motion along each axis, of its largest value
BEARING = np.diag([1e8, 1e8, 5e7, 2e5, 2e5, 0.0])  # N/m and N m/rad: a shaft turns freely about z
# none against tilting: Exudyn damps the angular velocity, which has a part of the spin across the axis where the rotor is tilted
DAMPER = np.diag([1e3, 1e3, 5e2, 0.0, 0.0, 0.0])
SPEED = 3000 * 2 * np.pi / 60  # rad/s
KNOCK = np.array([1e-5, 1e-5, 1e-5, 1e-4, 0.0, 0.0])  # m/s, rad/s
END, STEPS = 0.02, 400  # s, points compared

s = np.load(f"{sys.argv[1]}/superelement.npz")
m, k, b = s["m"], s["k"], len(s["interface_dofs"])  # the first b rows are the interface's, the others amplitudes of modes
first = s["interface_dofs"][:, 0] == 0
assert np.array_equal(s["interface_dofs"][first, 1], [1, 2, 3, 4, 5, 6]), "expected all motions of a centre node, in order"
hub = InertiaCylinder(density=7850, length=0.08, outerRadius=0.15, axis=2)


def system(speed, knock):
    """The system in Exudyn, and the rotor's node."""
    mbs = exudyn.SystemContainer().AddSystem()
    places = [[*place, 0, 0, 0] for place in s["interface_positions"][::6]]
    nodes = [mbs.AddNode(NodeRigidBodyRxyz(referenceCoordinates=place)) for place in places]
    if len(k) > b:
        zero = [0.0] * (len(k) - b)
        amplitudes = NodeGenericODE2(referenceCoordinates=zero, initialCoordinates=zero, initialCoordinates_t=zero)
        amplitudes.numberOfODE2Coordinates = len(zero)
        nodes.append(mbs.AddNode(amplitudes))
    mbs.AddObject(ObjectGenericODE2(nodeNumbers=nodes, massMatrix=m, stiffnessMatrix=k))
    rotor = mbs.AddNode(NodeRigidBodyRxyz(referenceCoordinates=places[0], initialVelocities=knock + [0, 0, 0, 0, 0, speed]))
    body = mbs.AddObject(ObjectRigidBody(mass=hub.mass, inertia=hub.GetInertia6D(), nodeNumber=rotor))
    ends = [mbs.AddMarker(MarkerNodeRigid(nodeNumber=nodes[0])), mbs.AddMarker(MarkerBodyRigid(bodyNumber=body))]
    mbs.AddObject(RigidBodySpringDamper(markerNumbers=ends, stiffness=BEARING, damping=DAMPER))
    shift = exudyn.OutputVariableType.Displacement
    motions = [mbs.AddSensor(SensorNode(nodeNumber=node, storeInternal=True, outputVariableType=shift)) for node in (rotor, nodes[0])]
    mbs.Assemble()
    return mbs, motions


def matrices():
    """M, C at rest, gyroscopic matrix per rad/s, and K: the superelement, then the rotor's six coordinates."""
    n = len(k)
    reach = np.zeros((6, n + 6))
    reach[:, :n][:, np.flatnonzero(first)] = -np.eye(6)
    reach[:, n:] = np.eye(6)
    mass = scipy.linalg.block_diag(m, hub.mass * np.eye(3), hub.inertiaTensor)
    turning = np.zeros_like(mass)
    turning[n + 3, n + 4], turning[n + 4, n + 3] = hub.inertiaTensor[2, 2], -hub.inertiaTensor[2, 2]
    return mass, reach.T @ DAMPER @ reach, turning, scipy.linalg.block_diag(k, np.zeros((6, 6))) + reach.T @ BEARING @ reach


def settings():
    given = exudyn.SimulationSettings()
    given.timeIntegration.endTime, given.timeIntegration.numberOfSteps = END, STEPS
    given.timeIntegration.absoluteTolerance, given.timeIntegration.relativeTolerance = 1e-15, 1e-10
    given.solution.sensors.writePeriod = END / STEPS
    given.solution.file.write = False
    given.timeIntegration.verboseMode = 0
    return given


print(f"Exudyn {exudyn.__version__}, SciPy {scipy.__version__}, NumPy {np.__version__}")
mass, damping, turning, stiffness = matrices()
n = len(mass)
expected = np.sqrt(scipy.linalg.eigh(stiffness, mass, eigvals_only=True).clip(0))[1:] / (2 * np.pi)  # less the free turn about z
found = np.sort(system(0.0, 0 * KNOCK)[0].ComputeODE2Eigenvalues(convert2Frequencies=True)[0])[1:]
apart = max(abs(found / expected - 1))
alone = np.sqrt(scipy.linalg.eigh(k, m, eigvals_only=True)) / (2 * np.pi)
ground = np.sqrt(scipy.linalg.eigh(BEARING, mass[-6:, -6:], eigvals_only=True).clip(0))[1:] / (2 * np.pi)
print("rotor on rigid ground, Hz", *(f"{hz:.3f}" for hz in ground))
print("housing alone            ", *(f"{hz:.3f}" for hz in alone[:5]))
print("together, Exudyn         ", *(f"{hz:.3f}" for hz in found[:8]))
print("together, SciPy          ", *(f"{hz:.3f}" for hz in expected[:8]))
print(f"largest difference of {len(found)} frequencies {apart:.1e}")

mbs, motions = system(SPEED, KNOCK)
mbs.SolveDynamic(settings(), solverType=exudyn.DynamicSolverType.DOPRI5)
inverse = np.linalg.inv(mass)
a = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ stiffness, -inverse @ (damping + SPEED * turning)]])
state = np.zeros(2 * n)
state[-6:] = KNOCK
worst = 0.0
for name, sensor, row in (("rotor", motions[0], len(k)), ("centre node", motions[1], 0)):
    times, *theirs = mbs.GetSensorStoredData(sensor).T
    own = np.array([scipy.linalg.expm(a * time) @ state for time in times])[:, row : row + 3].T
    difference = max(abs(theirs - own).max(axis=1) / abs(own).max(axis=1))
    worst = max(worst, difference)
    print(f"{name} at {SPEED:.0f} rad/s: x y z up to", *(f"{1e9 * value:.3f}" for value in abs(own).max(axis=1)), "nm;", end=" ")
    print(f"largest difference {difference:.1e}")
good = apart < WITHIN and worst < WITHIN
print(f"within {WITHIN:.0e}:", good)
sys.exit(0 if good else 1)
