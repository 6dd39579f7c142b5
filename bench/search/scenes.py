"""A scan of a part from one side, with known truth, and the part as a file of its own."""

import numpy as np
import parts
import trimesh
from trimesh import transformations

# of a range, mm
NOISE = 0.1
# surfaces seen at a flatter angle than this cosine are not measured
GRAZING = 0.15
# points of a part that is given as a cloud
POINTS = 80_000
SETTINGS = ["alone", "table", "alone", "bin"]
SCANS = ["ply", "npy", "pcd"]
PARTS = ["stl", "ply", "stl", "pcd"]
# of so many seeds one shows another part than the one that is looked for
ABSENT = 8


class Scene:
    """What is in the files: `poses` are scan_from_part, one for each part of the kind that is there."""

    def __init__(self, kind, seed):
        random = np.random.default_rng([kind, seed, 1])
        self.kind, self.seed = kind, seed
        self.family, make = parts.KINDS[kind]
        self.name = f"{make.__name__}_{seed}"
        self.part = parts.part(kind, seed)
        self.absent = random.uniform() < 1 / ABSENT
        self.setting, self.scan_format, self.part_format = (str(random.choice(some)) for some in (SETTINGS, SCANS, PARTS))
        self.scan_is_source = bool(random.uniform() < 0.5)
        self.group, self.axis = parts.symmetries(self.part)
        self.radius = np.linalg.norm(self.part.vertices, axis=1).max()
        shown = self.part
        if self.absent:
            other = (kind + 1 + random.integers(len(parts.KINDS) - 1)) % len(parts.KINDS)
            shown = parts.part(other, seed)
        self.points, poses = scanned(shown, kind, self.setting, random)
        # a cloud of a robot's program is in the robot's frame
        frame = anywhere(random, 1000.0) if self.scan_format == "pcd" else np.eye(4)
        self.points = self.points @ frame[:3, :3].T + frame[:3, 3]
        self.poses = [] if self.absent else [frame @ pose for pose in poses]
        # the part's own frame lies anywhere
        own = anywhere(random, 100.0)
        self.part_from_centre = own

    def cloud(self):
        """Points of the part, evenly laid, in its own frame."""
        points, _ = trimesh.sample.sample_surface_even(self.part, POINTS, seed=self.seed)
        return points @ self.part_from_centre[:3, :3].T + self.part_from_centre[:3, 3]

    def seen(self):
        points = self.points.reshape(-1, 3)
        return points[np.isfinite(points).all(1)]

    def write(self, folder):
        """Source and target, in the order in which the program gets them."""
        scan, part = (folder / f"{self.name}_{what}" for what in (f"scan.{self.scan_format}", f"part.{self.part_format}"))
        if self.scan_format == "npy":
            np.save(scan, (self.points * 1e-3).astype(np.float32))
        else:
            write_cloud(scan, self.seen() * 1e-3)
        if self.part_format == "stl":
            mesh = self.part.copy()
            mesh.apply_transform(self.part_from_centre)
            # in mm, as CAD writes it
            mesh.export(part)
        else:
            write_cloud(part, self.cloud() * 1e-3)
        return (scan, part) if self.scan_is_source else (part, scan)

    def error(self, target_from_source):
        """Degrees, and mm on average over the part, from the nearest place that is right; lengths in mm."""
        scan_from_part = np.linalg.inv(target_from_source) if self.scan_is_source else target_from_source
        found = scan_from_part @ self.part_from_centre
        points = self.part.vertices
        best = (180.0, np.inf)
        for pose in self.poses:
            off = np.linalg.inv(pose) @ found
            for same in self.group:
                by = off.copy()
                by[:3, :3] = by[:3, :3] @ same.T
                if self.axis is not None:
                    by[:3, :3] = by[:3, :3] @ about(self.axis, by[:3, :3]).T
                angle = np.degrees(np.arccos(np.clip((np.trace(by[:3, :3]) - 1) / 2, -1, 1)))
                moved = points @ by[:3, :3].T + by[:3, 3] - points
                best = min(best, (angle, np.linalg.norm(moved, axis=1).mean()), key=lambda e: e[0] / 0.3 + e[1] / 0.5)
        return best


def about(axis, rotation):
    """The turn about an axis in a rotation."""
    quaternion = transformations.quaternion_from_matrix(np.block([[rotation, np.zeros((3, 1))], [np.zeros((1, 3)), 1]]))
    angle = 2 * np.arctan2(quaternion[1:] @ axis, quaternion[0])
    return parts.turn(axis, angle)


def anywhere(random, reach):
    pose = transformations.random_rotation_matrix(random.uniform(size=3))
    pose[:3, 3] = random.uniform(-reach, reach, 3)
    return pose


def resting(mesh, random):
    """On a table at z = 0: on a side of its hull, a large one more often, turned about the vertical."""
    hull = mesh.convex_hull
    sides = [(hull.facets_area[k], hull.facets_normal[k]) for k in range(len(hull.facets))] or list(zip(hull.area_faces, hull.face_normals))
    areas = np.array([area for area, _ in sides])
    down = sides[random.choice(len(sides), p=areas / areas.sum())][1]
    pose = trimesh.geometry.align_vectors(down, [0, 0, -1])
    return transformations.rotation_matrix(random.uniform(0, 2 * np.pi), [0, 0, 1]) @ pose


def scanned(part, kind, setting, random):
    """Height x width x 3 points as a camera at the origin sees them, NaN where it sees nothing, and poses of the part."""
    meshes, poses = [part], [np.eye(4)]
    if setting == "alone":
        camera = looking_at(part, random.normal(size=3), random)
    else:
        meshes[0], poses[0] = laid(part, resting(part, random))
        if setting == "bin":
            fill(meshes, poses, part, kind, random)
        towards = np.array([*random.normal(scale=0.35, size=2), 1.0])
        camera = looking_at(meshes[0], towards, random)
        meshes.append(parts.box((2000, 2000, 10), (0, 0, -5)))
    # a wider view where there is more to see
    wide = 1.15 if setting == "alone" else random.uniform(1.3, 2.2)
    radius = np.linalg.norm(part.vertices, axis=1).max()
    distance = np.linalg.norm(camera[:3, 3] - meshes[0].bounds.mean(0))
    pitch = random.uniform(0.35, 0.6)
    side = int(2 * wide * radius / pitch)
    pixels = (np.mgrid[:side, :side] - 0.5 * (side - 1)) * (pitch / distance)
    rays = np.stack([pixels[1], pixels[0], np.ones((side, side))], -1)
    lengths = np.linalg.norm(rays, axis=-1, keepdims=True)
    rays /= lengths
    world = rays @ camera[:3, :3].T
    start = np.broadcast_to(camera[:3, 3], world.shape)
    hit = parts.solid(*meshes).cast_rays(np.concatenate([start, world], -1).astype(np.float32))
    hit = {key: hit[key].numpy() for key in ("t_hit", "primitive_normals")}
    cosine = np.abs((hit["primitive_normals"] * world).sum(-1))
    range_mm = hit["t_hit"] + random.normal(scale=NOISE, size=cosine.shape)
    range_mm[~np.isfinite(range_mm) | (cosine < GRAZING) | (random.uniform(size=cosine.shape) < 0.01)] = np.nan
    world_from_scan = camera
    return rays * range_mm[..., None], [np.linalg.inv(world_from_scan) @ pose for pose in poses]


def laid(mesh, pose):
    """Moved, so that its lowest point is at z = 0."""
    moved = mesh.copy()
    moved.apply_transform(pose)
    up = transformations.translation_matrix([0, 0, -moved.bounds[0, 2]])
    moved.apply_transform(up)
    return moved, up @ pose


def fill(meshes, poses, part, kind, random):
    """Other parts around, one more of the same in every second bin, and one above that hides some of it."""
    others = [int(k) for k in random.integers(len(parts.KINDS), size=3) if k != kind]
    again = random.uniform() < 0.5
    for number, other in enumerate(([kind] if again else []) + others):
        mesh = part if other == kind else parts.part(other, int(random.integers(1000)))
        mesh, pose = laid(mesh, resting(mesh, random))
        direction = random.uniform(0, 2 * np.pi)
        by = transformations.translation_matrix([np.cos(direction), np.sin(direction), 0])
        while any(overlap(mesh, there) for there in meshes):
            by[:3, 3] *= 1.1 if np.linalg.norm(by[:3, 3]) > 20 else 20
            mesh.apply_transform(by)
            pose = by @ pose
        meshes.append(mesh)
        if other == kind:
            poses.append(pose)
    if random.uniform() < 0.5:
        low, high = meshes[0].bounds
        at = [random.uniform(low[0], high[0]), high[1], high[2] + random.uniform(10, 30)]
        meshes.append(parts.rod(random.uniform(5, 10), 150, at, "y"))


def overlap(one, other):
    return bool((one.bounds[0] < other.bounds[1]).all() and (other.bounds[0] < one.bounds[1]).all())


def looking_at(mesh, towards, random):
    """world_from_camera: it looks along z at the middle of a mesh, from that side of it."""
    middle = mesh.bounds.mean(0)
    z = -towards / np.linalg.norm(towards)
    x = np.cross(z, random.normal(size=3))
    x /= np.linalg.norm(x)
    camera = np.eye(4)
    camera[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    camera[:3, 3] = middle - z * random.uniform(450, 750)
    return camera


def write_cloud(path, points):
    """Binary PLY or PCD, in metres, without normals or an order."""
    points = points.astype("<f4")
    if path.suffix == ".ply":
        head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n" + "".join(
            f"property float {axis}\n" for axis in "xyz") + "end_header\n"
    else:
        head = (f"# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {len(points)}\nHEIGHT 1\n"
                f"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(points)}\nDATA binary\n")
    path.write_bytes(head.encode() + points.tobytes())
