"""What fem.py reads of a scene: the body as a closed triangle mesh, and its unscattered light."""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import yaml

MILNE = 1.0656  # extrapolation length of a half-space over that of P1


def fail(text):
    sys.exit(f"fem.py: {text}")


def read_ply(path):
    data = path.read_bytes()
    head, body = data.split(b"end_header\n", 1)
    lines = head.decode().split("\n")
    counts = {w[1]: int(w[2]) for w in map(str.split, lines) if w[:1] == ["element"]}
    nv, nf = counts["vertex"], counts["face"]
    columns = [w[2] for w in map(str.split, lines) if w[:1] == ["property"] and w[1] != "list"]
    if "format ascii 1.0" in lines:
        numbers = np.array(body.split(), float)
        v = numbers[:nv * len(columns)].reshape(nv, -1)[:, :3]
        return v, numbers[nv * len(columns):].reshape(nf, 4)[:, 1:].astype(int)
    kinds = {"float": "<f4", "double": "<f8", "int": "<i4", "uint": "<u4", "uchar": "u1"}
    vertex = np.dtype([(w[2], kinds[w[1]]) for w in map(str.split, lines) if w[:1] == ["property"] and w[1] != "list"])
    v = np.frombuffer(body, vertex, nv)
    f = np.frombuffer(body, np.dtype([("n", "u1"), ("v", "<i4", 3)]), nf, nv * vertex.itemsize)
    return np.stack([v["x"], v["y"], v["z"]], 1).astype(float), f["v"].astype(int)


def read_obj(path):
    words = [line.split() for line in path.read_text().splitlines()]
    v = np.array([w[1:4] for w in words if w[:1] == ["v"]], float)
    return v, np.array([[int(t.split("/")[0]) - 1 for t in w[1:4]] for w in words if w[:1] == ["f"]])


def ball_mesh(center, radius, edge):
    """An icosahedron cut into smaller triangles, with the ball's volume."""
    g = (1 + 5 ** 0.5) / 2
    v = np.array([[0, s, t * g] for s in (-1, 1) for t in (-1, 1)])
    v = np.concatenate([v, v[:, [2, 0, 1]], v[:, [1, 2, 0]]])
    d = np.linalg.norm(v[:, None] - v, axis=2) < 2.1
    f = np.array([[i, j, k] for i in range(12) for j in range(i) for k in range(j) if d[i, j] and d[j, k] and d[i, k]])
    v /= np.linalg.norm(v[0])
    while radius * 1.05 / 2 ** (np.log2(len(f) / 20) / 2) > edge:
        e, at = np.unique(np.sort(f[:, [[0, 1], [1, 2], [2, 0]]], 2).reshape(-1, 2), axis=0, return_inverse=True)
        a, m = len(v), at.reshape(-1, 3) + len(v)
        v = np.concatenate([v, v[e].sum(1) / np.linalg.norm(v[e].sum(1), axis=1)[:, None]])
        f = np.concatenate([np.stack([f[:, 0], m[:, 0], m[:, 2]], 1), np.stack([f[:, 1], m[:, 1], m[:, 0]], 1),
                            np.stack([f[:, 2], m[:, 2], m[:, 1]], 1), m])
        assert a + len(e) == len(v)
    normals = np.cross(v[f[:, 1]] - v[f[:, 0]], v[f[:, 2]] - v[f[:, 0]])
    inwards = (normals * v[f[:, 0]]).sum(1) < 0
    f[inwards] = f[inwards][:, [0, 2, 1]]
    volume = np.einsum("ij,ij->", v[f[:, 0]], np.cross(v[f[:, 1]], v[f[:, 2]])) / 6
    return center + radius * (4 * np.pi / 3 / volume) ** (1 / 3) * v, f


def box_mesh(low, high):
    v = np.array([[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)], float)
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return v, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def write_surface(path, v, f):
    """As tetgen reads it."""
    with open(path, "w") as file:
        file.write(f"{len(v)} 3 0 0\n")
        np.savetxt(file, np.c_[np.arange(len(v)), v], "%d %.17g %.17g %.17g")
        file.write(f"{len(f)} 0\n")
        np.savetxt(file, np.c_[np.full(len(f), 3), f], "%d")
        file.write("0\n0\n")


def mended(v, f, most=10):
    """Triangles that cross, which tetgen cannot take: their corners go half way to the mean of their neighbours, until none
    does."""
    moved = set()
    for _ in range(most):
        with tempfile.TemporaryDirectory() as folder:
            write_surface(f"{folder}/m.smesh", v, f)
            report = subprocess.run(["tetgen", "-d", "m.smesh"], cwd=folder, capture_output=True, text=True).stdout
        corners = {int(i) for three in re.findall(r"\((\d+), (\d+), (\d+)\)", report) for i in three}
        if not corners:
            if moved:
                print(f"triangles that cross: {len(moved)} of their corners moved")
            return v
        moved |= corners
        means = {i: v[np.unique(f[(f == i).any(1)])].mean(0) for i in corners}
        v = v.copy()
        for i, mean in means.items():
            v[i] = 0.5 * (v[i] + mean)
    fail(f"triangles of the mesh still cross after {most} rounds of mending, expected a surface that does not")


class Scene:
    def __init__(self, path):
        self.path = Path(path)
        try:
            text = yaml.safe_load(self.path.read_text())
        except (OSError, yaml.YAMLError) as error:
            fail(f"{path}: cannot read, expected a scene: {' '.join(str(error).split())}")
        if len(text["objects"]) != 1:
            fail(f"{path}: objects: has {len(text['objects'])}, expected one")
        self.object = text["objects"][0]
        material = text["materials"][self.object["material"]]
        if any(material.get(key, default) != default for key, default in (("g", 0), ("ior", 1), ("emission", 0))):
            fail(f"{path}: materials: expected g = 0, ior = 1 and no emission")
        self.sigma_a, self.sigma_s = material["sigma_a"], material["sigma_s"]
        if isinstance(self.sigma_a, list) or isinstance(self.sigma_s, list):
            fail(f"{path}: materials: expected one channel")
        self.sigma_t = self.sigma_a + self.sigma_s
        self.lights = text["lights"]
        if any(light["type"] not in ("point", "directional") for light in self.lights):
            fail(f"{path}: lights: expected point and directional ones")
        longer = MILNE if text.get("solver", {}).get("boundary", "milne") == "milne" else 1.0
        self.loaded = self.read_mesh() if "mesh" in self.object else None
        self.k = 2 * longer / (3 * self.sigma_t)

    def convex(self):
        return "mesh" not in self.object

    def mesh(self, edge):
        """Corners and triangles, outwards; a sphere's have edges of this length at most."""
        if "sphere" in self.object:
            return ball_mesh(np.array(self.object["sphere"]["center"]), self.object["sphere"]["radius"], edge)
        if "box" in self.object:
            return box_mesh(self.object["box"]["min"], self.object["box"]["max"])
        return self.loaded

    def read_mesh(self):
        file = self.path.parent / self.object["mesh"]
        if file.suffix not in (".ply", ".obj") or not file.exists():
            fail(f"{file}: cannot read, expected a PLY or OBJ file")
        v, f = (read_ply if file.suffix == ".ply" else read_obj)(file)
        v = v * self.object.get("scale", 1)
        for axis, angle in enumerate(np.radians(self.object.get("rotate", [0, 0, 0]))):
            i, j = (axis + 1) % 3, (axis + 2) % 3
            c, s = np.cos(angle), np.sin(angle)
            v[:, i], v[:, j] = c * v[:, i] - s * v[:, j], s * v[:, i] + c * v[:, j]
        edges = np.sort(f[:, [[0, 1], [1, 2], [2, 0]]], 2).reshape(-1, 2)
        if (np.unique(edges, axis=0, return_counts=True)[1] != 2).any():
            fail(f"{file}: not closed, expected every edge to be of two triangles")
        return mended(v + self.object.get("translate", [0, 0, 0]), f), f


class Lamp:
    """Unscattered light: how far it comes through the body to a point, by looking from the lamp."""

    def __init__(self, light, v, f):
        self.point = light["type"] == "point"
        if self.point:
            self.at, self.strength = np.array(light["position"], float), light["intensity"]
            w = v.mean(0) - self.at
        else:
            self.at, self.strength = np.zeros(3), light["irradiance"]
            w = np.array(light["direction"], float)
        w /= np.linalg.norm(w)
        a = np.cross(w, np.eye(3)[np.abs(w).argmin()])
        self.axes = np.stack([a / np.linalg.norm(a), np.cross(w, a / np.linalg.norm(a)), w])
        uvz = self.project(v)
        if self.point and (uvz[:, 2] <= 0).any():
            fail("lights: a lamp stands among or in the object, expected it to see all of it at once")
        self.corners = uvz[f]
        p = self.corners[:, :, :2]
        self.area = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])  # < 0: faces the lamp
        # Each cell of a raster lists the triangles that may cover it.
        self.n = max(1, min(1024, int(len(f) ** 0.5)))
        self.low, self.cell = p.min((0, 1)), np.ptp(p, axis=(0, 1)) / self.n * (1 + 1e-9)
        first, last = self.raster(p.min(1)), self.raster(p.max(1))
        wide = last - first + 1
        triangle = np.repeat(np.arange(len(f)), wide.prod(1))
        step = np.arange(len(triangle)) - np.repeat(np.cumsum(wide.prod(1)) - wide.prod(1), wide.prod(1))
        key = (first[triangle, 0] + step // wide[triangle, 1]) * self.n + first[triangle, 1] + step % wide[triangle, 1]
        self.triangles = triangle[np.argsort(key, kind="stable")]
        self.begin = np.concatenate([[0], np.cumsum(np.bincount(key, minlength=self.n ** 2))])

    def project(self, x):
        uvz = (x - self.at) @ self.axes.T
        if self.point:
            uvz[:, :2] /= uvz[:, 2:]
        return uvz

    def raster(self, uv):
        return np.clip(((uv - self.low) / self.cell).astype(int), 0, self.n - 1)

    def path(self, x):
        """Length inside the body on the way to the lamp: all ways out less all ways in."""
        q = self.project(x)
        far = np.linalg.norm(x - self.at, axis=1) / q[:, 2] if self.point else np.ones(len(x))
        uv = q[:, :2] + 1e-7 * np.ptp(self.corners[:, :, :2], axis=(0, 1)) * (0.61, 0.37)  # off the edges of triangles
        cell = self.raster(uv) @ (self.n, 1)
        count = self.begin[cell + 1] - self.begin[cell]
        total = np.zeros(len(x))
        ends = np.cumsum(count)
        for chunk in np.split(np.arange(len(x)), np.searchsorted(ends, np.arange(1_000_000, ends[-1] + 1, 1_000_000))):
            own = np.repeat(chunk, count[chunk])
            step = np.arange(len(own)) - np.repeat(np.cumsum(count[chunk]) - count[chunk], count[chunk])
            t = self.triangles[self.begin[cell[own]] + step]
            p, c = uv[own], self.corners[t]
            b = [np.cross(c[:, (i + 1) % 3, :2] - p, c[:, (i + 2) % 3, :2] - p) / self.area[t] for i in range(3)]
            hit = (b[0] >= 0) & (b[1] >= 0) & (b[2] >= 0)
            own, t, c, b = own[hit], t[hit], c[hit], [one[hit] for one in b]
            # 1/z is linear over a picture from a point, z over one from infinity.
            z = sum(b[i] / c[:, i, 2] for i in range(3)) ** -1 if self.point else sum(b[i] * c[:, i, 2] for i in range(3))
            before = np.maximum(0, q[own, 2] - z) * far[own]
            total += np.bincount(own, np.where(self.area[t] < 0, before, -before), len(x))
        return np.maximum(0, total)

    def U_ri(self, x, path, sigma_t):
        fall = ((x - self.at) ** 2).sum(1) if self.point else 1.0
        return self.strength * np.exp(-sigma_t * path) / fall / (4 * np.pi)
