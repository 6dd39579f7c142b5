"""Forty kinds of parts, in mm, each with dimensions drawn from a seed, and the rotations that leave a part as it is."""

import numpy as np
import open3d
import trimesh
from trimesh import creation, transformations

# points by which symmetries are found; a rotation that moves none farther from the surface, mm, leaves the part as it is
SAMPLED, SAME = 6000, 0.05


def box(size, at=(0, 0, 0)):
    return placed(creation.box(extents=size), at)


def rod(radius, height, at=(0, 0, 0), axis="z", sections=64):
    turned = {"x": (0, np.pi / 2, 0), "y": (np.pi / 2, 0, 0), "z": (0, 0, 0)}[axis]
    return placed(creation.cylinder(radius, height, sections=sections), at, turned)


def ball(radius, at=(0, 0, 0)):
    return placed(creation.icosphere(3, radius), at)


def prism(outline, height):
    """An extruded polygon, its middle at z = 0."""
    corners = np.asarray(outline, float)
    count = len(corners)
    # convex outlines only: a fan of triangles
    fan = [[0, k, k + 1] for k in range(1, count - 1)]
    low, high = (np.column_stack([corners, np.full(count, z)]) for z in (-height / 2, height / 2))
    sides = [t for k in range(count) for t in ([k, (k + 1) % count, count + k], [(k + 1) % count, count + (k + 1) % count, count + k])]
    caps = [t[::-1] for t in fan] + [[count + v for v in t] for t in fan]
    return trimesh.Trimesh(np.vstack([low, high]), caps + sides)


def polygon(count, radius, phase=0.0):
    angles = phase + 2 * np.pi * np.arange(count) / count
    return np.column_stack([radius * np.cos(angles), radius * np.sin(angles)])


def placed(mesh, at=(0, 0, 0), turned=(0, 0, 0)):
    mesh = mesh.copy()
    mesh.apply_transform(transformations.translation_matrix(at) @ transformations.euler_matrix(*turned))
    return mesh


def union(*meshes):
    return trimesh.boolean.union(list(meshes), engine="manifold")


def cut(mesh, *tools):
    return trimesh.boolean.difference([mesh, *tools], engine="manifold")


def hull(*meshes):
    return trimesh.util.concatenate(list(meshes)).convex_hull


def revolved(profile):
    return creation.revolve(np.asarray(profile, float), sections=72)


# --- machined -------------------------------------------------------------------------------------


def rib_block(u):
    a, b, h = u(70, 110), u(45, 65), u(14, 24)
    return union(box((a, b, h)), box((u(8, 12), b, u(18, 30)), (-a * u(.2, .3), 0, h * .6)), rod(u(9, 13), u(28, 44), (a * u(.2, .3), b * u(.1, .2), h * .6)))


def step_block(u):
    a, b, h = u(70, 110), u(45, 60), u(30, 40)
    steps = box((a * .4, b * 2, h), (a * .4, 0, h * .5)), box((a * .3, b * .6, h), (-a * .5, b * .4, h * .6))
    return cut(box((a, b, h)), *steps, rod(u(5, 8), 99, (-a * .25, -b * .2, 0)), rod(u(4, 6), 99, (a * .3, b * .2, 0)))


def manifold_block(u):
    a, b, h = u(60, 90), u(40, 55), u(35, 45)
    bores = rod(u(7, 10), b, (-a * .25, -b * .4, 0), "y"), rod(u(5, 8), a, (a * .4, b * .1, h * .1), "x")
    return cut(box((a, b, h)), *bores, rod(u(8, 11), h, (a * .2, b * .1, h * .4)), rod(u(4, 6), 99, (-a * .35, b * .3, 0)))


def angle_bracket(u):
    a, b, h, t = u(60, 90), u(40, 60), u(50, 70), u(8, 12)
    gusset = placed(prism([(0, 0), (h * .6, 0), (0, h * .6)], t), (-a * .5 + t, u(-8, 8), t * .5), (np.pi / 2, 0, 0))
    plain = union(box((a, b, t)), box((t, b, h), (-a * .5 + t * .5, 0, h * .5)), gusset)
    return cut(plain, rod(5, 99, (a * .3, b * .25, 0)), rod(5, 99, (a * .2, -b * .3, 0)), rod(u(7, 10), 40, (-a * .5, b * .28, h * .7), "x"))


def bearing_housing(u):
    a, b, h, r = u(90, 120), u(30, 40), u(10, 14), u(20, 26)
    body = union(box((a, b, h)), rod(r + 8, b * .8, (0, 0, r + h * .4), "y"), box((2 * r + 8, b * .7, r), (0, 0, r * .5)))
    return cut(body, rod(r, 99, (0, 0, r + h * .4), "y"), rod(5, 99, (a * .4, 0, 0)), rod(5, 99, (-a * .4, b * .15, 0)), rod(3, 30, (4, b * .1, 2 * r + h)))


def clamp(u):
    a, b, h = u(70, 100), u(25, 35), u(22, 30)
    slot = box((a * .35, u(10, 14), 99), (a * .15, 0, 0))
    return cut(box((a, b, h)), slot, box((a * .3, 99, h * .5), (-a * .4, 0, -h * .4)), placed(box((a * .4, 99, h)), (a * .55, 0, h * .55), (0, .5, 0)))


def v_block(u):
    a, b, h = u(50, 80), u(45, 60), u(35, 45)
    return cut(box((a, b, h)), placed(box((999, b * .5, b * .5)), (0, u(-4, 4), h * .5), (np.pi / 4, 0, 0)), box((a * .15, 999, 8), (a * .2, 0, -h * .5)), rod(5, 99, (a * .35, b * .35, 0)))


def pocketed_plate(u):
    a, b, h = u(80, 120), u(55, 75), u(16, 22)
    pockets = box((a * .3, b * .5, h), (-a * .25, b * .1, h * .4)), box((a * .3, b * .3, h), (a * .2, -b * .2, h * .6))
    return cut(box((a, b, h)), *pockets, rod(b * .15, h, (a * .3, b * .25, h * .35)), box((12, 12, 99), (a * .5, b * .5, 0)))


def keyed_hub(u):
    r, h = u(16, 22), u(25, 40)
    body = union(rod(r, h), rod(r * 1.9, 10, (0, 0, -h * .5)))
    return cut(body, rod(r * .55, 99), box((r * .9, 6, 99), (r * .5, 0, 0)), rod(4, 99, (0, r * 1.5, 0)), rod(4, 99, (-r * 1.3, -r * .7, 0)))


def fork(u):
    a, w, h = u(60, 90), u(30, 40), u(18, 26)
    body = union(box((a, w, h)), rod(h * .5, w, (a * .5, 0, 0), "y"), rod(u(9, 12), u(25, 40), (-a * .6, 0, 0), "x"))
    return cut(body, box((a * .7, w * .45, 99), (a * .4, 0, 0)), rod(h * .27, 99, (a * .5, 0, 0), "y"), box((9, 99, 9), (-a * .3, w * .5, h * .5)))


# --- sheet metal ----------------------------------------------------------------------------------


def l_sheet(u):
    a, b, h, t = u(60, 100), u(40, 60), u(30, 50), u(1.5, 2.5)
    bent = union(box((a, b, t)), box((t, b, h), (-a * .5, 0, h * .5)))
    return cut(bent, rod(6, 20, (a * .3, b * .2, 0)), rod(3, 20, (0, -b * .3, 0)), box((20, b * .3, h * .3), (-a * .5, b * .2, h * .7)))


def u_sheet(u):
    a, b, h, t = u(60, 100), u(30, 50), u(25, 40), u(1.5, 2.5)
    bent = union(box((a, b, t)), box((a, t, h), (0, b * .5, h * .5)), box((a * .6, t, h * .7), (-a * .2, -b * .5, h * .35)))
    return cut(bent, rod(7, 20, (a * .25, 0, 0)), rod(4, 20, (-a * .3, b * .5, h * .6), "y"), box((18, 8, 20), (-a * .2, b * .1, 0)))


def z_sheet(u):
    a, b, h, t = u(30, 45), u(40, 60), u(20, 35), u(1.5, 2.5)
    bent = union(box((a, b, t), (-a * .5, 0, 0)), box((t, b, h + t), (0, 0, h * .5)), box((a * .8, b * .7, t), (a * .4, b * .15, h)))
    return cut(bent, rod(4, 20, (-a * .6, b * .25, 0)), rod(6, 20, (a * .45, b * .2, h)))


def hat_sheet(u):
    a, w, h, t = u(70, 110), u(22, 32), u(15, 25), u(1.5, 2.5)
    top, side = box((a, w, t), (0, 0, h)), [box((a, t, h + t), (0, s * w * .5, h * .5)) for s in (-1, 1)]
    flanges = box((a, 14, t), (0, w * .5 + 7, 0)), box((a * .7, 14, t), (-a * .15, -w * .5 - 7, 0))
    return cut(union(top, *side, *flanges), rod(5, 9, (a * .3, 0, h)), rod(3, 9, (-a * .35, w * .5 + 7, 0)))


def lid_sheet(u):
    a, b, h, t = u(60, 90), u(45, 60), u(12, 20), 2.0
    lid = cut(box((a, b, h)), box((a - 2 * t, b - 2 * t, h), (0, 0, -t)))
    return cut(lid, box((16, 99, h), (a * .2, b * .5, -h * .4)), rod(8, 99, (-a * .2, b * .1, 0)), box((14, 8, 99), (a * .25, -b * .2, 0)))


def perforated_sheet(u):
    a, b, h, t = u(80, 110), u(50, 70), u(12, 20), u(1.5, 2.0)
    holes = [rod(3.5, 20, (x, y, 0), sections=24) for x in np.linspace(-a * .35, a * .2, 5) for y in np.linspace(-b * .3, b * .1, 3)]
    return cut(union(box((a, b, t)), box((a * .6, t, h), (-a * .2, b * .5, h * .5)), box((t, b * .5, h * 1.5), (a * .5, -b * .25, h * .75))), *holes)


def clip_sheet(u):
    a, w, t = u(40, 60), u(18, 26), u(1.5, 2.0)
    arc = cut(rod(w * .5, w), rod(w * .5 - t, 99), box((99, 99, 99), (49.5, 0, 0)))
    legs = box((a, t, w), (a * .5 - 1, w * .5 - t * .5, 0)), box((a * .6, t, w), (a * .3 - 1, -w * .5 + t * .5, 0))
    return cut(union(arc, *legs), rod(4, 99, (a * .6, w * .5, w * .1), "y"))


def chassis_sheet(u):
    a, b, h, t = u(70, 100), u(50, 70), u(22, 32), 2.0
    walls = box((a, t, h), (0, b * .5, h * .5)), box((t, b, h * .6), (a * .5, 0, h * .3)), box((t, b * .4, h), (-a * .5, b * .3, h * .5))
    return cut(union(box((a, b, t)), *walls), box((a * .3, b * .3, 9), (-a * .15, -b * .15, 0)), rod(5, 99, (a * .3, b * .5, h * .6), "y"), rod(4, 9, (a * .35, -b * .35, 0)))


# --- castings -------------------------------------------------------------------------------------


def elbow(u):
    r, a = u(12, 16), u(35, 50)
    body = union(ball(r), rod(r, a, (a * .5, 0, 0), "x"), rod(r, a * .8, (0, 0, a * .4)), rod(r * 1.8, 7, (a, 0, 0), "x"), rod(r * 1.6, 7, (0, 0, a * .8)))
    return cut(body, rod(r * .6, 99, (60, 0, 0), "x"), rod(4, 30, (a, r * 1.35, 0), "x"))


def pump(u):
    r, a = u(26, 34), u(35, 45)
    foot = box((r * 1.8, r * 1.4, 8), (0, 0, -r * 1.1))
    neck = box((r, r * .6, r), (0, 0, -r * .7)), rod(r * .45, a, (r * .5, 0, r * .6), "z"), rod(r * .35, a, (-r * .2, a * .5, 0), "y")
    return union(hull(rod(r, 18, axis="y"), rod(r * .7, 30, axis="y")), foot, *neck)


def lever(u):
    a, r = u(70, 100), u(14, 20)
    arm = hull(ball(r * .6, (0, 0, 0)), ball(r * .35, (a, 0, u(5, 15))))
    return cut(union(arm, rod(r, r * 1.6), rod(r * .6, r * 1.2, (a, 0, 10))), rod(r * .5, 99), box((8, 5, 99), (r * .5, 0, 0)))


def tee(u):
    r, a = u(12, 17), u(70, 95)
    body = union(rod(r, a, axis="x"), rod(r * .8, a * .5, (a * u(-.1, .1), 0, a * .25)), rod(r * 1.7, 7, (a * .5, 0, 0), "x"), ball(r * 1.3))
    return union(body, rod(r * 1.4, 7, (-a * .5, 0, 0), "x"), box((r, r * 2.2, r * .8), (0, -r, -r * .6)))


def bossed_cover(u):
    a, b, h = u(70, 100), u(50, 65), u(14, 20)
    dome = hull(*[ball(h * .5, (x, y, 0)) for x in (-a * .5, a * .5) for y in (-b * .5, b * .4)])
    bosses = rod(9, h * 1.8, (-a * .3, b * .2, h * .3)), rod(7, h * 1.6, (a * .35, -b * .25, h * .3)), box((a * .5, 6, h * 1.6), (0, -b * .1, h * .2))
    return cut(union(dome, *bosses), box((999, 999, 99), (0, 0, -49.5 - h * .2)))


def knuckle(u):
    r, a = u(12, 16), u(35, 50)
    arms = [hull(ball(r, (0, 0, 0)), ball(r * s, at)) for s, at in ((.6, (a, 0, 8)), (.7, (-a * .4, a * .8, 0)), (.5, (-a * .5, -a * .6, 12)))]
    return union(*arms, rod(r * .8, a, (0, 0, r)))


def turbine_foot(u):
    a, h = u(50, 65), u(40, 60)
    cone = hull(rod(a * .5, 8), rod(a * .25, 4, (u(3, 8), 0, h)))
    ribs = [placed(box((a * .75, 6, h * k)), (a * .3 * np.cos(t), a * .3 * np.sin(t), h * k * .5), (0, 0, t)) for t, k in ((0, .5), (2.2, .7), (4.0, .4))]
    return union(cone, *ribs, box((20, 30, 8), (-a * .5, 0, 0)))


# --- nearly symmetric -----------------------------------------------------------------------------


def square_with_hole(u):
    a, h = u(55, 80), u(20, 30)
    return cut(box((a, a, h)), rod(u(7, 10), 99, (a * .3, a * .3, 0)), rod(a * .2, h, (0, 0, h * .5)))


def notched_hexagon(u):
    r, h = u(30, 40), u(22, 35)
    return cut(prism(polygon(6, r), h), box((14, 10, h), (r * .8, 0, h * .5)), rod(r * .4, 99))


def eccentric_disc(u):
    r, h = u(35, 45), u(14, 22)
    return cut(union(rod(r, h), rod(r * .4, h * 2, (0, 0, h * .5))), rod(u(6, 8), 99, (r * .65, 0, 0)), box((10, 6, h), (0, r, h * .4)))


def chamfered_cube(u):
    a = u(40, 60)
    return cut(box((a, a, a)), placed(box((a, a, a)), (a * .82, a * .82, 0), (0, 0, np.pi / 4)), rod(u(6, 9), 20, (0, 0, a * .5)))


def flatted_shaft(u):
    r, a = u(12, 18), u(80, 110)
    shaft = union(rod(r, a), rod(r * 1.5, 14, (0, 0, a * .25)))
    return cut(shaft, box((r, 99, a * .3), (r * 1.1, 0, -a * .4)), box((6, 6, a * .2), (0, r, a * .4)))


def offset_slot_bar(u):
    a, b, h = u(80, 110), u(35, 45), u(25, 32)
    return cut(box((a, b, h)), box((12, 99, h), (a * .15, 0, h * .6)), box((a, 8, 8), (0, 0, h * .5)))


# --- symmetric ------------------------------------------------------------------------------------


def plain_box(u):
    return box((u(70, 90), u(45, 55), u(25, 35)))


def square_post(u):
    a = u(35, 45)
    return union(box((a, a, u(15, 20))), box((a * .5, a * .5, u(60, 90)), (0, 0, 20)))


def turned_shaft(u):
    r, a = u(10, 14), u(80, 110)
    return union(rod(r, a), rod(r * 1.8, 20, (0, 0, a * .2)), rod(r * 1.4, 15, (0, 0, -a * .3)))


def cross(u):
    a, w, h = u(80, 100), u(18, 24), u(15, 22)
    return union(box((a, w, h)), box((w, a, h)), rod(w * .4, h * 2))


def lobed_flange(u):
    r, h = u(25, 32), u(10, 14)
    lobes = [rod(10, h, (1.3 * r * np.cos(t), 1.3 * r * np.sin(t), 0)) for t in (0, 2 * np.pi / 3, 4 * np.pi / 3)]
    return cut(union(rod(r, h), rod(r * .6, h * 3, (0, 0, h)), *lobes), rod(r * .35, 99))


# --- flat -----------------------------------------------------------------------------------------


def gasket(u):
    a, b = u(80, 110), u(50, 70)
    return cut(box((a, b, 4)), rod(b * .3, 9, (-a * .2, 0, 0)), box((a * .25, b * .5, 9), (a * .25, b * .05, 0)), rod(4, 9, (a * .4, -b * .4, 0)), box((15, 15, 9), (-a * .5, b * .5, 0)))


def key_plate(u):
    a, r = u(60, 90), u(18, 24)
    plate = union(rod(r, 5, (-a * .5, 0, 0)), box((a, r * .8, 5)), box((10, r * 1.2, 5), (a * .3, r * .5, 0)), box((8, r, 5), (a * .45, r * .4, 0)))
    return cut(plate, rod(r * .4, 9, (-a * .55, 0, 0)))


def slotted_strip(u):
    a, b = u(100, 140), u(30, 40)
    slots = [box((w, 7, 9), (x * a, y * b, 0)) for x, y, w in ((-.3, .2, 30), (.1, -.2, 22), (.35, .15, 14))]
    return cut(box((a, b, 3)), *slots, rod(5, 9, (-a * .4, -b * .25, 0)), placed(box((30, 30, 9)), (a * .5, b * .5, 0), (0, 0, .6)))


def arm_plate(u):
    a, r = u(70, 95), u(14, 18)
    plate = union(hull(rod(r, 6), rod(r * .7, 6, (a, 0, 0))), hull(rod(r, 6), rod(r * .5, 6, (-a * .3, a * .5, 0))))
    return cut(plate, rod(r * .5, 9), rod(r * .35, 9, (a, 0, 0)), box((a * .3, 6, 9), (a * .5, 0, 0)))


FAMILIES = {
    "machined": [rib_block, step_block, manifold_block, angle_bracket, bearing_housing, clamp, v_block, pocketed_plate, keyed_hub, fork],
    "sheet metal": [l_sheet, u_sheet, z_sheet, hat_sheet, lid_sheet, perforated_sheet, clip_sheet, chassis_sheet],
    "castings": [elbow, pump, lever, tee, bossed_cover, knuckle, turbine_foot],
    "nearly symmetric": [square_with_hole, notched_hexagon, eccentric_disc, chamfered_cube, flatted_shaft, offset_slot_bar],
    "symmetric": [plain_box, square_post, turned_shaft, cross, lobed_flange],
    "flat": [gasket, key_plate, slotted_strip, arm_plate],
}
KINDS = [(family, make) for family, makers in FAMILIES.items() for make in makers]


def part(kind, seed):
    """The part, its centre of mass at the origin."""
    random = np.random.default_rng([kind, seed])
    mesh = KINDS[kind][1](lambda low, high: random.uniform(low, high))
    mesh.apply_translation(-mesh.center_mass)
    return mesh


def symmetries(mesh):
    """Rotations about the centre that leave the part as it is, 3 x 3 each, and the axis about which all do, or none."""
    points, _ = trimesh.sample.sample_surface(mesh, SAMPLED, seed=1)
    scene = solid(mesh)

    def keeps(axis, angle):
        moved = (points @ turn(axis, angle).T).astype(np.float32)
        return all(scene.compute_distance(some).numpy().max() < SAME for some in (moved[:40], moved[:400], moved))

    turns = [(axis, 2 * np.pi * k / n) for axis in np.eye(3) for n, steps in ((6, range(1, 6)), (4, (1, 3))) for k in steps]
    turns += [(axis, np.pi) for axis in ([1, 1, 0], [1, -1, 0], [1, 0, 1], [1, 0, -1], [0, 1, 1], [0, 1, -1])]
    group = [np.eye(3)] + [turn(*by) for by in turns if keeps(*by)]
    # whole facets of what is round
    free = [axis for axis in np.eye(3) if all(keeps(axis, 2 * np.pi * k / 64) for k in (5, 23))]
    return group, (free[0] if free else None)


def turn(axis, angle):
    return transformations.rotation_matrix(angle, axis)[:3, :3]


def solid(*meshes):
    """Open3D's scene of meshes, in which rays end."""
    scene = open3d.t.geometry.RaycastingScene()
    for mesh in meshes:
        scene.add_triangles(mesh.vertices.astype(np.float32), mesh.faces.astype(np.uint32))
    return scene
