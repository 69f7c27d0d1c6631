#!/usr/bin/python3
"""Finite elements on the scene of a chart: a rival that is optional and that nothing else needs.

  tests/bars/fem.py scenes/pictures/torus.yaml DIR [--program build/knotlight] [--levels 4] [--from 0]

DIR is what `knotlight chart SCENE -o DIR` left. Solves lap U - lambda^2 U = -3 sigma_s sigma_t U_ri, U + k dU/dn = 0,
on quadratic tetrahedra of several finenesses, one thread, and writes the error at DIR/points.csv, processor seconds
(tetgen included) and memory as DIR/finite_elements.csv; `chart` on the same folder shows them from then on.

From Debian: apt-get install python3-numpy python3-scipy python3-yaml tetgen
It takes scenes of one object (sphere, box, closed PLY or OBJ mesh) with g = 0, ior = 1 and one channel, lit by point
or directional lights from outside.
"""
import argparse
import csv
import itertools
import multiprocessing
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"
try:
    import numpy as np
    import scipy.sparse as sp
    from scipy.sparse.linalg import LinearOperator, cg
    from scipy.spatial import cKDTree

    from fem_scene import Lamp, Scene, fail, write_surface
except ImportError as missing:
    sys.exit(f"fem.py: {missing}; expected Debian's python3-numpy, python3-scipy, python3-yaml, tetgen and /usr/bin/python3")

# (quality: largest radius of a tetrahedron over its shortest edge; size in mean free paths where light enters)
LEVELS = [(6.0, 3.0), (3.0, 1.7), (2.0, 1.2), (1.6, 0.9), (1.5, 0.65)]
RESIDUAL = 1e-5  # of the conjugate gradients, relative: far below the errors of any mesh here
HEADER = ("line,setting,level,not_trusted,field_cpu_seconds,picture_cpu_seconds,picture_wall_seconds,memory_MiB,own_error_estimate,"
          "field_error,field_noise,field_numerical,field_model,picture_error,picture_noise,picture_numerical,picture_model").split(",")


# --- Tetrahedra

def tetgen(folder, flags, name):
    done = subprocess.run(["tetgen", *flags, name], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        fail("tetgen: " + (done.stdout + done.stderr).strip().split("\n")[-1])


def read_table(path, columns, kind):
    with open(path) as file:
        count = int(file.readline().split()[0])
        return np.loadtxt(file, kind, usecols=columns, max_rows=count, ndmin=2)


def volumes(x, tets):
    a = x[tets]
    return np.abs(np.einsum("ij,ij->i", a[:, 1] - a[:, 0], np.cross(a[:, 2] - a[:, 0], a[:, 3] - a[:, 0]))) / 6


def make_mesh(v, f, quality, size, folder):
    """Refined, at most so many times, until few tetrahedra are larger than those of edge size(x)."""
    rounds, few = 4, 0.02
    write_surface(folder / "m.smesh", v, f)
    tetgen(folder, [f"-pq{quality}/5", "-Q"], "m.smesh")
    for i in range(1, rounds + 1):
        x, tets = read_table(folder / f"m.{i}.node", (1, 2, 3), float), read_table(folder / f"m.{i}.ele", (1, 2, 3, 4), int)
        wanted = size(x[tets].mean(1)) ** 3 / 72 ** 0.5  # of the regular tetrahedron
        large = volumes(x, tets) > wanted
        if i == rounds or large.mean() < few:
            return x, tets, read_table(folder / f"m.{i}.face", (1, 2, 3), int)
        with open(folder / f"m.{i}.vol", "w") as file:
            file.write(f"{len(tets)}\n")
            np.savetxt(file, np.c_[np.arange(len(tets)), np.where(large, wanted, -1)], "%d %.6g")
        tetgen(folder, [f"-rq{quality}/5", "-aQ"], f"m.{i}")


EDGES = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
# Mass of quadratic functions, vertices first: over V / 420 and area / 180.
TET_MASS = np.zeros((10, 10))
TET_MASS[:4, :4] = 1 + 5 * np.eye(4)
TRI_MASS = np.array([[6, -1, -1, 0, -4, 0], [-1, 6, -1, 0, 0, -4], [-1, -1, 6, -4, 0, 0],
                     [0, 0, -4, 32, 16, 16], [-4, 0, 0, 16, 32, 16], [0, -4, 0, 16, 16, 32]]) / 180
for i, one in enumerate(EDGES):
    for j in range(4):
        TET_MASS[4 + i, j] = TET_MASS[j, 4 + i] = -4 if j in one else -6
    for j, other in enumerate(EDGES):
        TET_MASS[4 + i, 4 + j] = (8, 16, 32)[len(set(one) & set(other))]
TET_MASS /= 420


def fourteen_points():
    """Barycentric coordinates, weights and quadratic functions; exact to degree 5 (N. J. Walkington, 2000)."""
    points, weights = [], []
    for a, w in ((0.31088591926330060980, 0.11268792571801585080), (0.092735250310891226402, 0.073493043116361949544)):
        for i in range(4):
            points.append(np.where(np.arange(4) == i, 1 - 3 * a, a))
            weights.append(w)
    for i, j in EDGES:
        points.append(np.where(np.isin(np.arange(4), (i, j)), 0.5 - 0.045503704125649649492, 0.045503704125649649492))
        weights.append(0.042546020777081466438)
    b = np.array(points)
    functions = [b * (2 * b - 1)] + [4 * b[:, p:p + 1] * b[:, q:q + 1] for p, q in EDGES]
    return b, np.array(weights), np.concatenate(functions, 1)


def stiffness():
    """Integrals of products of derivatives by barycentric coordinates, 16 x 100, over the volume; four points are exact."""
    c = np.zeros((4, 4, 10, 10))
    for point in range(4):
        b = np.full(4, (5 - 5 ** 0.5) / 20)
        b[point] = (5 + 3 * 5 ** 0.5) / 20
        d = np.zeros((10, 4))
        d[:4] = np.diag(4 * b - 1)
        for i, (p, q) in enumerate(EDGES):
            d[4 + i, p], d[4 + i, q] = 4 * b[q], 4 * b[p]
        c += np.einsum("ia,jb->abij", d, d) / 4
    return c.reshape(16, 100)


def solve(x, tets, faces, scene, lamps):
    """U at vertices and middles of edges, and the six of each face."""
    n = len(x)
    pairs = np.sort(tets[:, EDGES].reshape(-1, 2), 1)
    keys, at = np.unique(pairs[:, 0] * n + pairs[:, 1], return_inverse=True)
    nodes = np.concatenate([tets, n + at.reshape(-1, 6)], 1).astype(np.int32)
    pairs = np.sort(faces[:, [(0, 1), (1, 2), (2, 0)]].reshape(-1, 2), 1)
    face_nodes = np.concatenate([faces, n + np.searchsorted(keys, pairs[:, 0] * n + pairs[:, 1]).reshape(-1, 3)], 1).astype(np.int32)
    count = n + len(keys)

    v = volumes(x, tets)
    right = np.zeros(count)
    inner, weights, functions = fourteen_points()
    for i in range(0, len(tets), 50_000):
        part = slice(i, i + 50_000)
        places = np.einsum("qa,eak->eqk", inner, x[tets[part]]).reshape(-1, 3)
        light = sum(lamp.U_ri(places, lamp.path(places), scene.sigma_t) for lamp in lamps).reshape(-1, len(weights))
        right += np.bincount(nodes[part].ravel(), ((light * weights * v[part, None]) @ functions).ravel(), count)
    right *= 3 * scene.sigma_s * scene.sigma_t
    area = np.linalg.norm(np.cross(x[faces[:, 1]] - x[faces[:, 0]], x[faces[:, 2]] - x[faces[:, 0]]), axis=1) / 2
    matrix = sp.coo_matrix(((area[:, None] / scene.k * TRI_MASS.reshape(1, 36)).ravel(),
                            (np.repeat(face_nodes, 6, 1).ravel(), np.tile(face_nodes, (1, 6)).ravel())), (count, count)).tocsr()
    reference, lambda2 = stiffness(), 3 * scene.sigma_a * scene.sigma_t
    for i in range(0, len(tets), 100_000):
        part = slice(i, i + 100_000)
        corners = x[tets[part]]
        gradients = np.linalg.inv(corners[:, 1:] - corners[:, :1])
        gradients = np.concatenate([-gradients.sum(2, keepdims=True), gradients], 2)
        products = np.einsum("eka,ekb->eab", gradients, gradients).reshape(-1, 16)
        blocks = (products @ reference + lambda2 * TET_MASS.reshape(1, 100)) * v[part, None]
        matrix += sp.coo_matrix((blocks.ravel(), (np.repeat(nodes[part], 10, 1).ravel(), np.tile(nodes[part], (1, 10)).ravel())),
                                (count, count)).tocsr()
    diagonal = matrix.diagonal()
    u, failed = cg(matrix, right, tol=RESIDUAL, M=LinearOperator((count, count), lambda r: r / diagonal))
    if failed:
        fail("the conjugate gradients did not converge")
    return u, face_nodes


def evaluate(points, x, faces, u, face_nodes):
    """U where each point lies over one of the nearest faces."""
    near = cKDTree(x[faces].mean(1)).query(points, min(24, len(faces)))[1]
    a, b, c = (x[faces[near, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    size = (normal ** 2).sum(2)
    p = points[:, None]
    weights = np.stack([(np.cross(b - p, c - p) * normal).sum(2), (np.cross(c - p, a - p) * normal).sum(2),
                        (np.cross(a - p, b - p) * normal).sum(2)], 2) / size[:, :, None]
    height = np.abs(((p - a) * normal).sum(2)) / size ** 0.5
    # Over the face, and of several such the one that it is nearest to (thin walls have two sides).
    best = (np.maximum(0, -weights.min(2)) * size ** 0.25 + height).argmin(1)
    rows = np.arange(len(points))
    w = np.clip(weights[rows, best], 0, 1)
    w /= w.sum(1)[:, None]
    shape = np.concatenate([w * (2 * w - 1), 4 * w * w[:, [1, 2, 0]]], 1)
    return (shape * u[face_nodes[near[rows, best]]]).sum(1)


def run_level(level, scene, points, pipe):
    start = [time.process_time(), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss]
    quality, size = LEVELS[level]
    v, f = scene.mesh(size / scene.sigma_t)
    lamps = [Lamp(light, v, f) for light in scene.lights]
    widest = 0.5 / (3 * scene.sigma_a * scene.sigma_t) ** 0.5

    def wanted(at):
        """Smaller where light slants in, larger where little of it is left."""
        step, steepest, size_at = 2e-4 * np.ptp(v, axis=0).max(), 3.0, widest
        for lamp in lamps:
            path = lamp.path(at)
            slope = sum(((lamp.path(at + step * e) - path) / step) ** 2 for e in np.eye(3)) ** 0.5
            size_at = np.minimum(size_at, size / scene.sigma_t * (1 / np.clip(slope, 1, steepest) + 0.5 * scene.sigma_t * path))
        return size_at

    with tempfile.TemporaryDirectory() as folder:
        x, tets, faces = make_mesh(v, f, quality, wanted, Path(folder))
    u, face_nodes = solve(x, tets, faces, scene, lamps)
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = time.process_time() - start[0] + children.ru_utime + children.ru_stime
    peak = max(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - start[1], children.ru_maxrss) / 1024
    pipe.send((f"{len(u)} unknowns, {len(tets)} quadratic tetrahedra", seconds, peak, evaluate(points, x, faces, u, face_nodes)))


# --- What it is measured against

def read_points(path):
    if not path.exists():
        fail(f"{path}: no such file, expected the folder of `knotlight chart` of this version")
    table = np.genfromtxt(path, delimiter=",", skip_header=1)
    return table[:, :3], table[:, 3], table[:, 4]


def returning_light(scene, points, program):
    """What light that has left the body and enters it again adds to U_d, which the elements do not follow: the program's
    answers with and without it, over some seeds, as one is known to 0.3 % only."""
    seeds, difference = 4, 0.0
    with tempfile.TemporaryDirectory() as folder:
        np.savetxt(f"{folder}/p.csv", points, "%.17g", ",", header="x,y,z", comments="")
        for seed, (word, sign) in itertools.product(range(1, seeds + 1), (("true", 1), ("false", -1))):
            done = subprocess.run([program, "probe", scene.path, "--points", f"{folder}/p.csv", "-o", f"{folder}/u.csv", "--quiet",
                                   "--seed", str(seed), "--set", f"solver.returning_light={word}", "--set", "solver.tolerance=0.01"],
                                  capture_output=True, text=True)
            if not Path(f"{folder}/u.csv").exists():
                fail((done.stderr.strip().split("\n") or [f"{program}: failed"])[0])
            difference += sign / seeds * np.genfromtxt(f"{folder}/u.csv", delimiter=",", skip_header=1, usecols=3)
            os.remove(f"{folder}/u.csv")
    return difference


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scene")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--program", default=Path(__file__).resolve().parents[2] / "build/knotlight", type=Path)
    parser.add_argument("--levels", type=int, default=4, choices=range(1, len(LEVELS) + 1), help="how many finenesses")
    parser.add_argument("--from", dest="first", type=int, default=0, choices=range(len(LEVELS)), help="the coarsest of them")
    options = parser.parse_args()
    if shutil.which("tetgen") is None:
        fail("no program tetgen, expected Debian's package of that name")
    scene = Scene(options.scene)
    points, areas, truth = read_points(options.folder / "points.csv")
    if not scene.convex():
        if not options.program.exists():
            fail(f"{options.program}: no such program, expected knotlight (--program)")
        added = returning_light(scene, points, options.program)
        print(f"returning light: {100 * np.sqrt((areas * added ** 2).sum() / (areas * truth ** 2).sum()):.2f} % of the field, taken off")
        truth = truth - added
    rows = []
    for level in range(options.first, min(options.first + options.levels, len(LEVELS))):
        receive, send = multiprocessing.get_context("fork").Pipe(False)
        process = multiprocessing.get_context("fork").Process(target=run_level, args=(level, scene, points, send))
        process.start()
        send.close()
        try:
            setting, seconds, memory, u = receive.recv()
        except EOFError:
            sys.exit(1)
        finally:
            process.join()
        error = np.sqrt((areas * (u - truth) ** 2).sum() / (areas * truth ** 2).sum())
        print(f"{setting}: {seconds:.2f} CPU s, {memory:.0f} MiB, error {100 * error:.3f} %", flush=True)
        rows.append(["finite elements", setting, level, "", seconds, "nan", "nan", memory, "nan", error, "nan", error, 0.0]
                    + ["nan"] * 4)
    unfinished = options.folder / "finite_elements.csv.part"
    with open(unfinished, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([HEADER, *rows])
    unfinished.replace(options.folder / "finite_elements.csv")


if __name__ == "__main__":
    main()
