#!/usr/bin/env python3
"""One mesh through `fe_node solve` and through CalculiX's explicit dynamics; displacements compared.

A steel cantilever of one-point bricks gets a tip load at t = 0 and swings for one and a half
periods of its first mode. Both programs integrate with central differences and a lumped mass on the
same nodes; they differ in the hourglass control (both only resist zero-energy modes) and in the
bulk viscosity (off here). So the tip histories must agree within a few per cent of the amplitude,
which also has to be the beam's: twice the static deflection, f1 = 0.5596 / L^2 sqrt(EI / (rho A)).

    bench/compare_calculix.py [--fe-node build/release/bin/fe_node] [--keep FOLDER]

Prints the table and exits 0 when they agree, 1 when not, 77 when `ccx` is absent (skipped).
"""

import argparse
import math
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time

E, NU, RHO = 210e9, 0.3, 7850.0
LENGTH, HEIGHT = 0.080, 0.020
CELLS = (16, 4, 4)
LOAD = 10e3  # N, all tip nodes together: static deflection 0.6 mm
FRAMES = 60
# Share of the amplitude: hourglass forms differ, and four one-point bricks carry 4^2 / (4^2 - 1) of
# the bending stiffness or less, depending on that form.
AGREE = 0.05
BEAM = 0.12  # beam theory leaves out shear (HEIGHT / LENGTH = 1/4) and the mesh is coarse


def mesh():
    nx, ny, nz = CELLS
    nodes, ids = [], {}
    for k in range(nz + 1):
        for j in range(ny + 1):
            for i in range(nx + 1):
                ids[i, j, k] = len(nodes) + 1
                nodes.append((LENGTH * i / nx, HEIGHT * j / ny, HEIGHT * k / nz))
    bricks = []
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                low = [ids[i + a, j + b, k] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                high = [ids[i + a, j + b, k + 1] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                bricks.append(low + high)
    fixed = [n for (i, _, _), n in ids.items() if i == 0]
    tip = [n for (i, _, _), n in ids.items() if i == nx]
    return nodes, bricks, fixed, tip


def end_time():
    inertia, area = HEIGHT**4 / 12, HEIGHT**2
    return 1.5 / (0.5596 / LENGTH**2 * math.sqrt(E * inertia / (RHO * area)))


def keyword_deck(nodes, bricks, fixed, tip, end):
    """Fixed columns, units kg m s."""
    out = ["*KEYWORD", "*TITLE", "cantilever for comparison (kg, m, s)", "*CONTROL_TERMINATION"]
    out.append(f"{end:10.3e}")
    out += ["*CONTROL_BULK_VISCOSITY", f"{0.0:10.1f}{0.0:10.1f}"]
    out += ["*CONTROL_TIMESTEP", f"{0.0:10.1f}{0.8:10.1f}"]
    out += ["*CONTROL_HOURGLASS", f"{4:10d}{0.05:10.3f}"]
    out += ["*DATABASE_BINARY_D3PLOT", f"{end / FRAMES:10.3e}"]
    out += ["*PART", "bar", f"{1:10d}{1:10d}{1:10d}", "*SECTION_SOLID", f"{1:10d}{1:10d}"]
    out += ["*MAT_ELASTIC", f"{1:10d}{RHO:10.1f}{E:10.3e}{NU:10.3f}", "*NODE"]
    out += [f"{n:8d}{x:16.9e}{y:16.9e}{z:16.9e}" for n, (x, y, z) in enumerate(nodes, 1)]
    out.append("*ELEMENT_SOLID")
    out += [f"{e:8d}{1:8d}" + "".join(f"{n:8d}" for n in b) for e, b in enumerate(bricks, 1)]
    out.append("*BOUNDARY_SPC_NODE")
    out += [f"{n:10d}{0:10d}" + f"{1:10d}" * 3 for n in fixed]
    out += ["*DEFINE_CURVE", f"{1:10d}", f"{0.0:20.3f}{1.0:20.3f}", f"{1.0:20.3f}{1.0:20.3f}"]
    out.append("*LOAD_NODE_POINT")
    out += [f"{n:10d}{2:10d}{1:10d}{LOAD / len(tip):10.3f}" for n in tip]
    return "\n".join(out + ["*END"]) + "\n"


def calculix_deck(nodes, bricks, fixed, tip, end):
    def listed(numbers):
        lines = [numbers[i : i + 12] for i in range(0, len(numbers), 12)]
        return [", ".join(map(str, line)) for line in lines]

    step = 0.5 * (LENGTH / CELLS[0]) / math.sqrt(E * (1 - NU) / (RHO * (1 + NU) * (1 - 2 * NU)))
    every = max(1, round(end / FRAMES / step))  # CalculiX finds its own step, close to this one
    out = ["*NODE, NSET=ALL"]
    out += [f"{n}, {x:.9e}, {y:.9e}, {z:.9e}" for n, (x, y, z) in enumerate(nodes, 1)]
    out.append("*ELEMENT, TYPE=C3D8R, ELSET=BAR")
    out += [f"{e}, " + ", ".join(map(str, b)) for e, b in enumerate(bricks, 1)]
    out += ["*NSET, NSET=FIXED"] + listed(fixed) + ["*NSET, NSET=TIP"] + listed(tip)
    out += ["*MATERIAL, NAME=STEEL", "*ELASTIC", f"{E}, {NU}", "*DENSITY", f"{RHO}"]
    out += ["*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL", "*BOUNDARY", "FIXED, 1, 3"]
    out += ["*STEP, NLGEOM, INC=1000000", "*DYNAMIC, EXPLICIT", f"{step:.9e}, {end:.9e}"]
    out += ["*CLOAD", f"TIP, 2, {LOAD / len(tip)}"]
    out += [f"*NODE PRINT, NSET=TIP, FREQUENCY={every}", "U", "*END STEP"]
    return "\n".join(out) + "\n"


def run_calculix(folder, deck, tip):
    (folder / "bar.inp").write_text(deck)
    start = time.monotonic()
    done = subprocess.run(["ccx", "-i", "bar"], cwd=folder, capture_output=True, text=True)
    seconds = time.monotonic() - start
    if done.returncode != 0:
        sys.exit(f"ccx failed:\n{done.stdout[-2000:]}{done.stderr[-500:]}")
    history = [(0.0, 0.0)]
    values, now = [], 0.0
    for line in (folder / "bar.dat").read_text().splitlines():
        if "time" in line:
            if values:
                history.append((now, sum(values) / len(values)))
            now, values = float(line.split()[-1]), []
        else:
            fields = line.split()
            if len(fields) == 4 and int(fields[0]) in tip:
                values.append(float(fields[2]))
    history.append((now, sum(values) / len(values)))
    return history, seconds


def points_of(path):
    """Node positions of a field file: the first appended array."""
    data = path.read_bytes()
    begin = data.index(b"_", data.index(b"<AppendedData")) + 1
    (size,) = struct.unpack_from("<Q", data, begin)
    flat = struct.unpack_from(f"<{size // 4}f", data, begin + 8)
    return [flat[i : i + 3] for i in range(0, len(flat), 3)]


def run_crosswalk(folder, fe_node, deck):
    (folder / "bar.k").write_text(deck)
    out = folder / "solve"
    command = [str(fe_node), "solve", str(folder / "bar.k"), "--out", str(out), "--threads", "1"]
    start = time.monotonic()
    done = subprocess.run(command + ["--units", "m-kg-s"], capture_output=True, text=True)
    seconds = time.monotonic() - start
    if done.returncode != 0:
        sys.exit(f"fe_node failed:\n{done.stdout}{done.stderr}")
    history, tip, rest = [], None, 0.0
    for line in (out / "fields" / "fields.pvd").read_text().splitlines():
        if "timestep" not in line:
            continue
        moment, name = float(line.split('"')[1]), line.split('"')[3]
        points = points_of(out / "fields" / name)
        if tip is None:
            tip = [n for n, p in enumerate(points) if p[0] > LENGTH * (1 - 1e-4)]
            rest = sum(points[n][1] for n in tip) / len(tip)
        history.append((moment, sum(points[n][1] for n in tip) / len(tip) - rest))
    return history, seconds


def value(history, moment):
    for (t0, u0), (t1, u1) in zip(history, history[1:]):
        if t0 <= moment <= t1:
            return u0 + (u1 - u0) * (moment - t0) / (t1 - t0) if t1 > t0 else u1
    return history[-1][1]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    here = pathlib.Path(__file__).resolve().parent.parent
    parser.add_argument("--fe-node", default=here / "build/release/bin/fe_node")
    parser.add_argument("--keep", help="folder for decks and results")
    request = parser.parse_args()
    if shutil.which("ccx") is None:
        print("skipped: no ccx (Debian package calculix-ccx)")
        return 77
    folder = pathlib.Path(request.keep or tempfile.mkdtemp(prefix="compare_calculix_")).resolve()
    folder.mkdir(parents=True, exist_ok=True)

    nodes, bricks, fixed, tip = mesh()
    end = end_time()
    ours, our_seconds = run_crosswalk(
        folder, pathlib.Path(request.fe_node).resolve(), keyword_deck(nodes, bricks, fixed, tip, end)
    )
    theirs, their_seconds = run_calculix(
        folder, calculix_deck(nodes, bricks, fixed, tip, end), set(tip)
    )

    amplitude = max(abs(u) for _, u in theirs)
    worst = 0.0
    print("   t, us   CalculiX, mm   crosswalk, mm   difference, % of amplitude")
    for i in range(0, FRAMES + 1, 5):
        moment = end * i / FRAMES
        a, b = value(theirs, moment), value(ours, moment)
        print(f"{1e6 * moment:8.1f}{1e3 * a:15.5f}{1e3 * b:16.5f}{100 * (b - a) / amplitude:17.2f}")
    for moment, b in ours:
        worst = max(worst, abs(b - value(theirs, moment)) / amplitude)
    static = LOAD * LENGTH**3 / (3 * E * HEIGHT**4 / 12)
    ratio = max(abs(u) for _, u in ours) / (2 * static)
    print(f"largest difference {100 * worst:.2f} % of the amplitude (allowed {100 * AGREE:.0f} %)")
    print(f"amplitude / twice the static deflection of a beam: {ratio:.3f}")
    print(f"whole program: crosswalk {our_seconds:.2f} s, CalculiX {their_seconds:.2f} s")
    if request.keep is None:
        shutil.rmtree(folder)
    return 0 if worst <= AGREE and abs(ratio - 1) <= BEAM else 1


if __name__ == "__main__":
    sys.exit(main())
