"""Meshes and a scene from CAD: python3 -m debond mesh IMPLANT.step [BONE.step] --size 0.5 --out NAME.

Faces that both bodies have become `contact`, and are cut alike on both sides. Gmsh reads the STEP files, in mm whatever their
unit, and fills the bodies with tetrahedra of ten nodes."""

import math
import os
import re

import gmsh
import numpy

from .errors import InputError, expect
from .files import say, write_whole

#: Faces of a body that can be named in a word: which coordinate is the same all over, and at which end of the body.
ENDS = {"top": (2, 1), "bottom": (2, 0), "left": (0, 0), "right": (0, 1), "front": (1, 0), "back": (1, 1)}
COLOURS = {"contact": (214, 96, 77), "held": (67, 147, 195), "free": (200, 200, 200)}
TETRAHEDRON_10, TRIANGLE_6 = 11, 9  # of Gmsh
CELLS, MOST = 100, 500000           # squares of the usual size on the contact faces; tetrahedra that are made

SCENE = """# {title}. Meshes of {sources}, made by
#   {command}
# What stands behind <<< is missing: lines of debond --check say which values are usual.
set Title = {title}

subsection Bone
  set Shape         = file
  set Mesh file     = {name}_bone.msh
  # set Young modulus = <<< MPa
end

subsection Implant
  set Shape         = file
  set Mesh file     = {name}_implant.msh
  set Young modulus = 113000    # MPa, Ti-6Al-4V
end

subsection Interface
  # set Normal stiffness              = <<< MPa/mm
  set Tangential stiffness          = auto   # as the normal one
  set Law                           = adhesive   # a bond holds without pressure; friction, for a press fit: Interference
  # set Friction coefficient broken   = <<<
  # set Friction coefficient unbroken = <<<
  # set Characteristic slip distance  = <<< mm
  set Transition factor             = 1
  subsection Bonding
    # set Bonding degree = <<< 0 to 1
  end
  subsection Adhesive
    # set Strength        = <<< MPa (prm/cad/post_pulled.prm assumes 2)
    # set Gap at strength = <<< mm  (0.01 there)
  end
end

subsection Chuck
  subsection Translation z
    set Value = 0.1 * t    # mm: the implant is pulled along z
  end
end

subsection Load steps
  set Times = 0, 1
end

subsection Output
  set Directory = {name}_results
end
{expert}"""
EXPERT = """
subsection Expert    # meshes for the estimate of the error
  subsection Bone
    set Coarser mesh file = {name}_bone_coarser.msh
  end
  subsection Implant
    set Coarser mesh file = {name}_implant_coarser.msh
  end
end
"""


def _mm(number) -> str:
    return f"{number:.4g}"


def _faces(solid):
    return {tag for _, tag in gmsh.model.getBoundary([(3, solid)], oriented=False)}


def _box(dimension, tag):
    """Lowest and highest corner (2, 3) [mm]; of a spline, whose control points may be far away, of points on it."""
    if dimension == 3:
        boxes = numpy.array([_box(2, face) for face in _faces(tag)])
        return numpy.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])
    if gmsh.model.getType(2, tag) in ("Plane", "Cylinder", "Cone", "Sphere", "Torus"):
        return numpy.reshape(gmsh.model.getBoundingBox(2, tag), (2, 3))
    grid = numpy.meshgrid(*(numpy.linspace(*ends, 129) for ends in zip(*gmsh.model.getParametrizationBounds(2, tag))))
    x = numpy.reshape(gmsh.model.getValue(2, tag, numpy.stack(grid, axis=-1).ravel()), (-1, 3))
    return numpy.array([x.min(axis=0), x.max(axis=0)])


def _is_upright(face):
    """Whether the normal in its middle is horizontal, or nearly so."""
    middle = numpy.mean(gmsh.model.getParametrizationBounds(2, face), axis=0)
    return abs(gmsh.model.getNormal(face, middle)[2]) < 0.1


def _number(option, text):
    """A length [mm]."""
    try:
        number = float(text)
    except ValueError:
        number = 0.0
    expect(0 < number < 1e4, option, text, "a length in mm")
    return number


def _read(filename):
    """The one solid of a STEP file, in mm."""
    expect(os.path.isfile(filename), "mesh", filename, "a STEP file that is there")
    try:
        found = gmsh.model.occ.importShapes(filename)
    except Exception as error:  # of OpenCASCADE, of many kinds
        raise InputError(f"mesh: {filename}: it cannot be read: {error}") from None
    solids = [tag for dimension, tag in found if dimension == 3]
    if len(solids) != 1:
        raise InputError(f"mesh: {filename}: it has {len(solids)} solids: expected one; " +
                         ("join them, or export the one that is meant" if solids else "close the surface in the CAD program, and export a solid"))
    gmsh.model.occ.synchronize()
    size = max(_box(3, solids[0])[1] - _box(3, solids[0])[0])
    say(f"{filename}: {' x '.join(map(_mm, _box(3, solids[0])[1] - _box(3, solids[0])[0]))} mm, {_mm(gmsh.model.occ.getMass(3, solids[0]))} mm^3")
    if not 0.5 < size < 500:
        say(f"warning: {filename} is {_mm(size)} mm long: is its unit that of the drawing? --scale 25.4, 10 or 1000 make inches, cm or m of it")
    return solids[0]


def _block(text, implant, depth):
    """Bone around an implant that is `depth` deep in it, or all of it [mm]: AxBxC is a block, DxC a cylinder of diameter D."""
    sizes, (low, high) = [_number("--bone", part) for part in text.split("x")], _box(3, implant)
    expect(len(sizes) in (2, 3), "--bone", text, "AxBxC of a block or DxC of a cylinder, in mm")
    (x, y), top = ((low + high) / 2)[:2], low[2] + _number("--depth", depth) if depth else high[2]
    through = (1 + 1e-6) * sizes[-1] / (top - low[2])  # a hole may go through
    if min(sizes[0] / (high - low)[0], sizes[len(sizes) - 2] / (high - low)[1], through) <= 1:
        raise InputError(f"--bone {text}: expected more than the implant takes, {' x '.join(map(_mm, (*(high - low)[:2], top - low[2])))} mm")
    if len(sizes) == 3:
        return gmsh.model.occ.addBox(x - sizes[0] / 2, y - sizes[1] / 2, top - sizes[2], *sizes)
    return gmsh.model.occ.addCylinder(x, y, top - sizes[1], 0, 0, sizes[1], sizes[0] / 2)


def _join(implant, bone):
    """Cuts the implant out of the bone, so that faces where they touch are those of both; returns implant, bone and these faces."""
    occ, before = gmsh.model.occ, gmsh.model.occ.getMass(3, bone)
    left, _ = occ.cut([(3, bone)], [(3, implant)], removeTool=False)
    if not left:
        raise InputError("mesh: nothing is left of the bone: expected one larger than the implant, and the file of the implant first")
    _, (of_implant, *of_bone) = occ.fragment([(3, implant)], left)
    occ.synchronize()
    pieces = [tag for made in of_bone for _, tag in made]
    implant, bone = of_implant[0][1], max(pieces, key=lambda tag: occ.getMass(3, tag))
    if len(pieces) > 1:
        lost = sum(occ.getMass(3, tag) for tag in pieces if tag != bone)
        say(f"warning: the implant cuts the bone into {len(pieces)} pieces; {_mm(lost)} mm^3 are left out")
    say(f"the implant takes {_mm(before - sum(occ.getMass(3, tag) for tag in pieces))} mm^3 of the bone")
    contact = _faces(implant) & _faces(bone)
    if not contact:
        raise InputError("mesh: no face of the implant lies on one of the bone: expected bodies in place, in one system of coordinates")
    return implant, bone, contact


def _colour(face):
    """That of a face in the STEP file, as RRGGBB; empty without one."""
    *rgb, alpha = gmsh.model.getColor(2, face)
    return "%02x%02x%02x" % tuple(rgb) if alpha else ""


def _chosen(word, at, own, option):
    """Free faces of a body that a word names: those `at` its ends, beyond a plane, or of a colour."""
    kind, _, value = word.partition("=")
    if kind in ("above", "below") and value:
        expect(re.fullmatch(r"[+-]?(\d+\.?\d*|\.\d+)", value), option, word, "a place along z in mm, as above=1.5")
        return {face for face in own if (_box(2, face)[0, 2] > float(value) - 1e-6 if kind == "above" else _box(2, face)[1, 2] < float(value) + 1e-6)}
    if kind == "colour" and value:
        return {face for face in own if _colour(face) == value.lower()}
    expect(word in at, option, word, ", ".join(at) + ", above=Z, below=Z (mm), colour=RRGGBB")
    return at[word]


def _held(solid, contact, words, option):
    """Faces of a body at its ends, or for `sides` flat ones at its ends in x and y, where there are none
    upright ones that reach these ends; or those that _chosen() finds."""
    own, (low, high) = _faces(solid) - contact, _box(3, solid)
    slack = 1e-3 * max(high - low)
    at = {word: {face for face in own if numpy.abs(_box(2, face)[:, d] - (low, high)[end][d]).max() < slack} for word, (d, end) in ENDS.items()}
    at["sides"] = set()
    for word in ("left", "right", "front", "back"):
        d, end = ENDS[word]
        at["sides"] |= at[word] or {face for face in own if abs(_box(2, face)[end, d] - (low, high)[end][d]) < slack and _is_upright(face)}
    found = set()
    for word in words.split(","):
        chosen = _chosen(word, at, own, option)
        if not chosen:
            colours = ", ".join(sorted(set(map(_colour, own)) - {""})) or "no colour"
            raise InputError(f"{option} {word}: no free face of the body is there, or none that is flat: expected "
                             f"another word, above=Z for all faces beyond a place along z, or a colour of the file (its free faces have {colours})")
        found |= chosen
    return found


def _sharp_edges(faces):
    """Edges at which these faces end, or meet at more than 40 degrees. Where one face meets itself is a seam."""
    faces_at = {}
    for face in faces:
        own = [edge for _, edge in gmsh.model.getBoundary([(2, face)], combined=False, oriented=False)]
        for edge in own:
            if own.count(edge) == 1 and gmsh.model.getType(1, edge) != "Unknown":
                faces_at.setdefault(edge, []).append(face)
    sharp = set()
    for edge, beside in faces_at.items():
        (first,), (last,) = gmsh.model.getParametrizationBounds(1, edge)
        middle = gmsh.model.getValue(1, edge, [(first + last) / 2])
        normals = [gmsh.model.getNormal(face, gmsh.model.getParametrization(2, face, middle)) for face in beside]
        if len(beside) == 1 or abs(numpy.dot(*normals[:2])) < math.cos(math.radians(40)):
            sharp.add(edge)
    return sharp


def _fields(contact):
    """Distances from contact faces and from their edges, and sizes of cells by these: the tags of those."""
    field, sizes = gmsh.model.mesh.field, []
    for what, tags in (("FacesList", contact), ("EdgesList", _sharp_edges(contact))):
        if tags:
            distance, size = field.add("Distance"), field.add("Threshold")
            field.setNumbers(distance, what, sorted(tags))
            field.setNumber(distance, "NNodesByEdge", 100)
            field.setNumber(size, "IField", distance)
            sizes.append(size)
    least = field.add("Min")
    field.setNumbers(least, "FieldsList", sizes)
    field.setAsBackgroundMesh(least)
    return sizes


def _fill(implant, bone, fields, size, edge_size):
    """Tetrahedra of ten nodes, whose edges are `size` long at the contact faces, `edge_size` along edges of these, and up to three
    times that far away [mm]."""
    gmsh.model.mesh.clear()
    for tag, least in zip(fields, (size, edge_size)):
        for name, value in (("LcMin", least), ("LcMax", 3 * size), ("DistMin", 0.5 * least), ("DistMax", 8 * size)):
            gmsh.model.mesh.field.setNumber(tag, name, value)
    for name, value in (("MeshSizeExtendFromBoundary", 0), ("MeshSizeFromPoints", 0), ("MeshSizeFromCurvature", 0), ("ElementOrder", 2), ("HighOrderOptimize", 0)):
        gmsh.option.setNumber("Mesh." + name, value)
    gmsh.model.mesh.generate(3)
    try:
        gmsh.model.mesh.optimize("HighOrder")
    except Exception:  # not as good as it wants, see _n_tangled
        pass


def _fill_untangled(implant, bone, fields, size, edge_size, factors=(1, 0.85, 0.72, 0.61, 0.52)):
    """The same with smaller ones where curved sides tangle some; returns how much smaller, a factor, or None."""
    for factor in factors:
        _fill(implant, bone, fields, factor * size, factor * edge_size)
        if not _n_tangled():
            return factor
    return None


def _tetrahedra(solid=-1):
    """Nodes of those of a body, or of both (n, 10, 3) [mm]."""
    nodes, x, _ = gmsh.model.mesh.getNodes()
    place = numpy.zeros((int(max(nodes)) + 1, 3))
    place[nodes.astype(int)] = x.reshape(-1, 3)
    return place[gmsh.model.mesh.getElementsByType(TETRAHEDRON_10, solid)[1].reshape(-1, 10).astype(int)]


def _smallest_angle(solid):
    """Between two faces of a tetrahedron of a body, at its vertices [deg]; and how many there are."""
    corners, smallest = _tetrahedra(solid), 180.0
    for i, j, k, m in ((0, 1, 2, 3), (0, 2, 1, 3), (0, 3, 1, 2), (1, 2, 0, 3), (1, 3, 0, 2), (2, 3, 0, 1)):
        edge = corners[:, j] - corners[:, i]
        a, b = (numpy.cross(edge, corners[:, n] - corners[:, i]) for n in (k, m))
        cosine = (a * b).sum(axis=1) / numpy.linalg.norm(a, axis=1) / numpy.linalg.norm(b, axis=1)
        smallest = min(smallest, math.degrees(math.acos(min(1.0, cosine.max()))))
    return smallest, len(corners)


def _n_tangled():
    """How many tetrahedra are inside out at a vertex or in the middle of edges, faces or themselves."""
    own = _tetrahedra()
    edges, is_wrong = ((0, 1), (1, 2), (2, 0), (3, 0), (3, 2), (3, 1)), numpy.zeros(len(own), dtype=bool)  # in the order of Gmsh
    for corners in range(1, 16):
        w = numpy.array([corners >> v & 1 for v in range(4)], dtype=float)
        w /= w.sum()
        by_w = numpy.zeros((10, 4))  # of the functions of the second order
        by_w[range(4), range(4)] = 4 * w - 1
        for node, (i, j) in enumerate(edges, 4):
            by_w[node, [i, j]] = 4 * w[j], 4 * w[i]
        J = numpy.einsum("nad,av->ndv", own, by_w)
        is_wrong |= numpy.linalg.det(J[:, :, 1:] - J[:, :, :1]) <= 1e-3 * numpy.abs(numpy.linalg.det((own[:, 1:4] - own[:, :1]).transpose(0, 2, 1)))
    return is_wrong.sum()


def _write(filename, solid, groups):
    """One body, with its named faces."""
    gmsh.model.removePhysicalGroups()
    gmsh.model.addPhysicalGroup(3, [solid])
    for name, faces in groups.items():
        gmsh.model.removePhysicalName(name)
        gmsh.model.setPhysicalName(2, gmsh.model.addPhysicalGroup(2, sorted(faces)), name)
    gmsh.write(filename)


def _triangles(face):
    """Corners of each (3, 3) [mm]."""
    tags, x, _ = gmsh.model.mesh.getNodes(2, face, includeBoundary=True)
    place = dict(zip(tags, x.reshape(-1, 3)))
    own = gmsh.model.mesh.getElementsByType(TRIANGLE_6, face)[1].reshape(-1, 6)[:, :3]
    return [numpy.array([place[node] for node in triangle]) for triangle in own]


def _picture(bodies):
    """Both bodies from the side and above, one beside the other, the bone cut open; colours say which faces are named. SVG."""
    view = numpy.array([[0.866, -0.5, 0.0], [0.25, 0.433, 0.866], [0.433, 0.75, -0.5]])  # right, up, away
    drawn, left = [], 0.0
    for solid, groups, is_cut in bodies:
        parts = []
        for face in _faces(solid):
            kind = next((name for name, faces in groups.items() if face in faces), "free")
            parts += [(kind, one) for one in _triangles(face)]
        middle = numpy.mean([one.mean(axis=0) for _, one in parts], axis=0)
        if is_cut:
            parts = [(kind, one) for kind, one in parts if (one.mean(axis=0) - middle) @ [0.5, 0.866, 0] > 0]
        seen = [(kind, one @ view.T, numpy.cross(one[1] - one[0], one[2] - one[0])) for kind, one in parts]
        shift = left - min(one[:, 0].min() for _, one, _ in seen)
        left = shift + max(one[:, 0].max() for _, one, _ in seen) + 0.05 * abs(left - shift) + 1
        for kind, one, normal in sorted(seen, key=lambda part: -part[1][:, 2].mean()):
            light = 0.55 + 0.45 * abs(normal @ [0.3, -0.5, 0.8]) / (numpy.linalg.norm(normal) + 1e-300)
            drawn.append(((one[:, :2] + [shift, 0]) * [1, -1], "#%02x%02x%02x" % tuple(int(light * c) for c in COLOURS[kind])))
    low = numpy.min([points.min(axis=0) for points, _ in drawn], axis=0)
    high = numpy.max([points.max(axis=0) for points, _ in drawn], axis=0)
    scale = 900 / (high - low)[0]
    polygons = "".join('<polygon points="%s" fill="%s"/>\n' % (" ".join("%.1f,%.1f" % tuple(scale * (p - low) + 10) for p in points), colour)
                       for points, colour in drawn)
    height = scale * (high - low)[1] + 50
    words = "".join(f'<text x="{20 + 180 * i}" y="{height - 12:.0f}" fill="rgb{COLOURS[kind]}">{kind}</text>' for i, kind in enumerate(COLOURS))
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 920 {height:.0f}" width="100%" font-family="sans-serif" stroke="#555" '
            f'stroke-width="0.3">\n{polygons}{words}</svg>\n')


def _mesh(files, options):
    """Reads, joins, fills and writes; prints what has come of it."""
    gmsh.option.setNumber("Geometry.OCCScaling", _number("--scale", options["--scale"] or 1))
    implant = _read(files[0])
    if len(files) > 1:
        expect(not options["--bone"], "--bone", options["--bone"], "no block beside a STEP file of the bone")
        bone = _read(files[1])
    elif options["--bone"]:
        bone = _block(options["--bone"], implant, options["--depth"])
    else:
        raise InputError("mesh: there is no bone: expected a second STEP file, or --bone 12x12x8 for a block around the implant")
    implant, bone, contact = _join(implant, bone)
    groups = {implant: {"contact": contact, "held": _held(implant, contact, options["--held"], "--held")},
              bone: {"contact": contact, "held": _held(bone, contact, options["--bone-held"], "--bone-held")}}
    expect(bool(options["--out"]) and os.path.isdir(os.path.dirname(options["--out"]) or "."), "--out", options["--out"],
           "what the names of the files begin with, in a directory that is there")
    size = _number("--size", options["--size"] or math.sqrt(sum(gmsh.model.occ.getMass(2, face) for face in contact) / CELLS))
    edge_size, name = _number("--edge-size", options["--edge-size"] or size), options["--out"]
    gmsh.model.removeEntities([(3, tag) for _, tag in gmsh.model.getEntities(3) if tag not in (implant, bone)], recursive=True)
    # some five times as many as equal ones far away, and a layer of smaller ones
    n = sum(gmsh.model.occ.getMass(3, solid) for solid in groups) / (0.12 * (3 * size) ** 3) + 25 * sum(
        gmsh.model.occ.getMass(2, face) for face in contact) / size**2
    if n > MOST:
        raise InputError(f"mesh: cells of {_mm(size)} mm would be some {n:.2g} tetrahedra: expected a larger --size, less bone, or another --scale of the files")
    fields = _fields(contact)
    factor = _fill_untangled(implant, bone, fields, size, edge_size)
    if factor is None:
        raise InputError("mesh: curved sides tangle cells of all sizes tried: expected a smaller --size, or a file without slivers")
    if factor < 1:
        say(f"with cells of {_mm(size)} mm curved sides tangle some: they are {_mm(factor * size)} mm")
    bodies = ((implant, "implant"), (bone, "bone"))
    for solid, body in bodies:
        angle, cells = _smallest_angle(solid)
        areas = ", ".join(f"{kind} {_mm(sum(gmsh.model.occ.getMass(2, face) for face in faces))} mm^2" for kind, faces in groups[solid].items())
        say(f"{body}: {_mm(gmsh.model.occ.getMass(3, solid))} mm^3, {areas}; {cells} tetrahedra of {_mm(factor * size)} mm, smallest angle {angle:.0f} degrees")
        if angle < 1:
            say(f"warning: some cells of the {body} are flat: another --size, or bone that is not that thin, makes better ones")
        _write(f"{name}_{body}.msh", solid, groups[solid])
    unknowns = 12 * sum(len(gmsh.model.mesh.getElementsByType(TRIANGLE_6, face)[0]) for face in contact)  # 3 of each of 2 x 2 nodes
    if unknowns > 60000:
        raise InputError(f"mesh: the contact faces have some {unknowns} unknowns, which take 50 GB and more: expected a larger --size")
    if unknowns > 15000:
        say(f"warning: the contact faces have some {unknowns} unknowns (15000 take minutes and 3.5 GB, twice as many four times that): "
            "take a larger --size, or a rigid implant")
    write_whole(name + ".svg", _picture([(implant, groups[implant], False), (bone, groups[bone], True)]))
    has_coarser = _fill_untangled(implant, bone, fields, 1.5 * factor * size, 1.5 * factor * edge_size, (1, 0.9))
    for solid, body in bodies if has_coarser else ():
        _write(f"{name}_{body}_coarser.msh", solid, groups[solid])
    command = f"python3 -m debond mesh {' '.join(files)}" + "".join(f" {word} {value}" for word, value in options.items() if value)
    write_whole(name + ".prm", SCENE.format(title=f"{os.path.basename(files[0])} in bone", sources=" and ".join(files), command=command, name=name,
                                             expert=EXPERT.format(name=name) if has_coarser else ""))
    if not has_coarser:
        say("warning: cells 1.5 times as long would be tangled: the error cannot be estimated well, compare two sizes")
    say(f"{name}_implant.msh, {name}_bone.msh, {name}.prm and {name}.svg written: fill in what is missing in {name}.prm")


def main(*arguments) -> int:
    """Writes NAME_implant.msh, NAME_bone.msh, NAME.prm and NAME.svg; returns the exit code."""
    *files, options = arguments
    gmsh.initialize(["debond"], False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        _mesh(files, options)
    except InputError:
        raise
    except Exception as error:  # Gmsh raises nothing else; a file that cannot be written, cells that cannot be made
        raise InputError(f"mesh: Gmsh gave up; another --size may help, or a file without slivers: {error}") from None
    finally:
        gmsh.finalize()
    return 0
