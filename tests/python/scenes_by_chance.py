"""Small scenes by chance, for relations.py: all shapes, laws and drives, materials, elements and patterns. Numbers are drawn, so
that no state is a tie that rounding decides: nothing stands still at its limit of friction, nothing just touches."""

import math
import random
import struct
import zlib

import numpy

SHAPES = ("coin", "pin", "block", "taper", "ring", "cup in a shell", "cap", "screw", "fitted coin", "cup in a block", "file")
LAWS = ("coulomb", "modified coulomb", "adhesive", "table", "ageing", "mixed mode", "slip", "dilatant", "frictionless")
EXPERT = ("Quadrature points", "Slave", "Evolution", "Opening viscosity", "Exponent", "Contact surface", "Layer grading", "Lateral grading", "Resolution",
          "File columns")
DRIVES = ("twisted", "by a moment", "by a spring", "sheared", "tilted", "pulled", "cyclic", "by a force", "all at once", "tables")
CORNERS = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])  # of a cell
SIDES = {"bottom": (0, 1, 2, 3), "top": (4, 5, 6, 7), "x": ((0, 3, 7, 4), (1, 2, 6, 5)), "y": ((0, 1, 5, 4), (3, 2, 6, 7))}


class Table:
    """Of a CSV file: columns by their names."""

    suffix = "csv"

    def __init__(self, **columns):
        self.columns = columns

    def moved(self, P, L, T):
        """By a motion P of space, with lengths times L and times times T."""
        columns = {name: numpy.array(values) * {"slip_mm": L, "time": T}.get(name, 1) for name, values in self.columns.items()}
        if "x" in columns:
            places = [columns["x"], columns["y"], columns.get("z", 0 * columns["x"])]
            columns.update(zip("xyz"[:3 if "z" in columns else 2], L * P @ places))
        return Table(**columns)

    def content(self):
        rows = [",".join(repr(float(value)) for value in row) for row in zip(*self.columns.values())]
        return ("\n".join([",".join(self.columns), *rows]) + "\n").encode()


class Picture:
    """Of 8 bits, as it is written: rows from the top."""

    suffix = "png"

    def __init__(self, grey):
        self.grey = grey

    def moved(self, P, L, T):
        grey = self.grey[::-1].T  # over x, y
        grey = grey.T if P[0, 1] else grey
        return Picture(grey[::int(P[0].sum()), ::int(P[1].sum())].T[::-1])

    def content(self):
        height, width = self.grey.shape
        chunks = ((b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)),
                  (b"IDAT", zlib.compress(b"".join(b"\0" + bytes(int(level) for level in row) for row in self.grey))), (b"IEND", b""))
        return b"\x89PNG\r\n\x1a\n" + b"".join(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
                                                 for kind, data in chunks)


class Mesh:
    """Hexahedra with groups of their sides; corners are numbered as Gmsh and Abaqus do."""

    suffix = "msh"

    def __init__(self, nodes, cells, groups):
        self.nodes, self.cells, self.groups = nodes, cells, groups

    @staticmethod
    def box(cells, place, groups):
        """place: of the point (i, j, k) of a lattice of cells; groups: {name: sides}."""
        n = numpy.array(cells)
        number = lambda i: int(numpy.ravel_multi_index(tuple(i), tuple(n + 1)))
        lattice = list(numpy.ndindex(*n))
        on_side = {"bottom": lambda c: c[2] == 0, "top": lambda c: c[2] == n[2] - 1,
                   "x": lambda c: (c[0] == 0, c[0] == n[0] - 1), "y": lambda c: (c[1] == 0, c[1] == n[1] - 1)}
        corners = {c: [number(c + corner) for corner in CORNERS] for c in lattice}
        faces = {}
        for name, side in groups.items():
            sides = SIDES[side] if side in "xy" else (SIDES[side],)
            faces[name] = [[corners[c][v] for v in one] for c in lattice
                           for one, is_there in zip(sides, numpy.atleast_1d(on_side[side](c))) if is_there]
        return Mesh(numpy.array([place(*i) for i in numpy.ndindex(*(n + 1))]), list(corners.values()), faces)

    def moved(self, P, L, T):
        cells = self.cells if numpy.linalg.det(P) > 0 else [[*c[4:], *c[:4]] for c in self.cells]
        groups = {{"slides x": "slides y", "slides y": "slides x"}.get(name, name) if P[0, 1] else name: faces for name, faces in self.groups.items()}
        return Mesh(L * self.nodes @ P.T, cells, groups)

    def renumbered(self, chance):
        """Other numbers of nodes, cells and corners, in a file of another format."""
        order = chance.sample(range(len(self.nodes)), len(self.nodes))
        nodes = numpy.empty_like(self.nodes)
        nodes[order] = self.nodes
        turns = ((1, 2, 3, 0, 5, 6, 7, 4), (3, 2, 6, 7, 0, 1, 5, 4), (4, 7, 6, 5, 0, 3, 2, 1))
        turned = lambda cell: [cell[v] for v in chance.choice(turns)]
        cells = [turned(turned([order[v] for v in cell])) for cell in self.cells]
        mesh = Mesh(nodes, chance.sample(cells, len(cells)),
                    {name: [[order[v] for v in face] for face in faces] for name, faces in self.groups.items()})
        mesh.suffix = "inp"
        return mesh

    def content(self):
        nodes = [" ".join(repr(float(x)) for x in node) for node in self.nodes]
        names = ("contact", "held", "slides x", "slides y")
        faces = [(names.index(name) + 1, face) for name, faces in self.groups.items() for face in faces]
        if self.suffix == "inp":
            sides = (0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)
            side_of = {frozenset(cell[v] for v in side): f"{c + 1}, S{s + 1}" for c, cell in enumerate(self.cells) for s, side in enumerate(sides)}
            lines = ["*Node", *(f"{i + 1}, {node.replace(' ', ', ')}" for i, node in enumerate(nodes)), "*Element, type=C3D8",
                     *(f"{c + 1}, {', '.join(str(v + 1) for v in cell)}" for c, cell in enumerate(self.cells))]
            for name, own in self.groups.items():
                lines += [f'*Surface, type=ELEMENT, name="{name}"', *(side_of[frozenset(face)] for face in own)]
            return ("\n".join(lines) + "\n").encode()
        elements = [(f"3 2 {group} {group}", face) for group, face in faces] + [("5 2 9 9", cell) for cell in self.cells]
        return ("\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "5", *(f'2 {i + 1} "{name}"' for i, name in enumerate(names)),
                          '3 9 "body"', "$EndPhysicalNames", "$Nodes", str(len(nodes)), *(f"{i + 1} {node}" for i, node in enumerate(nodes)),
                          "$EndNodes", "$Elements", str(len(elements)),
                          *(f"{i + 1} {kind} {' '.join(str(v + 1) for v in corners)}" for i, (kind, corners) in enumerate(elements)),
                          "$EndElements"]) + "\n").encode()


class Drawn:
    """entries: {"Subsection/Entry": text}, values of files "{NAME}" being those of `files`; what: shape, law and drive."""

    def __init__(self, seed):
        self.chance = random.Random(f"scene {seed}")
        self.what = SHAPES[seed % len(SHAPES)], LAWS[seed % len(LAWS)], DRIVES[seed % len(DRIVES)]
        self.entries, self.files = {"Expert/Load steps/Residual tolerance": "1e-12", "Output/Report": "false"}, {}
        self.in_bore = self.what[0].split()[0] in ("pin", "taper", "screw", "cup")
        self.on_side = self.in_bore and not self.what[0].startswith("cup")
        self.E = self.number(2e3, 2e4)
        self.p = self.number(1.5, 4)
        for part in (self.add_interface, self.add_bodies, self.add_pattern, self.add_times, self.add_drive):
            part()

    def number(self, low, high):
        return float(f"{self.chance.uniform(low, high):.4g}")

    def maybe(self, share):
        return self.chance.random() < share

    def set(self, section, **entries):
        for name, value in entries.items():
            name = name.replace("_", " ")
            self.entries["Expert/" * (name in EXPERT) + f"{section}/{name}"] = str(value)

    def file(self, name, what):
        self.files[name] = what
        return "{" + name + "}"

    def add_interface(self):
        law, r = self.what[1], self.number
        self.eps, self.mu = r(400, 900), r(0.3, 0.5)
        self.set("Interface", Normal_stiffness=self.eps, Tangential_stiffness=self.eps if self.maybe(0.2) else r(300, 700), Quadrature_points=self.chance.choice((1, 2, 2, 3, 3, 4)),
                 Slave="bone" if self.maybe(0.25) else "implant", Law=law if law in ("adhesive", "mixed mode", "dilatant") else "friction",
                 Friction_law="rate and state" if law in ("ageing", "slip") else law if law in LAWS[:2] + ("table", "frictionless")
                 else self.chance.choice(("coulomb", "modified coulomb")))
        friction = self.entries["Interface/Friction law"]
        if friction == "coulomb":
            self.set("Interface", Friction_coefficient=self.mu)
        if friction in ("modified coulomb", "table"):
            self.set("Interface", Friction_coefficient_broken=self.mu, Friction_coefficient_unbroken=round(self.mu + r(0.05, 0.2), 4))
        if friction == "modified coulomb" or law == "adhesive":
            self.set("Interface", Characteristic_slip_distance=r(0.015, 0.03), Transition_factor=r(0.5, 1.2))
        if friction == "table":
            a = r(0.02, 0.04)
            self.set("Interface", Friction_table=self.file("law", Table(slip_mm=[0, a, 2.1 * a, 3 * a, 4.2 * a], phi=[1, 0.93, 0.4, 0.07, 0])))
        if friction == "rate and state":
            self.set("Interface/Rate and state", Evolution=law, Reference_coefficient=self.mu, Direct_effect=r(0.01, 0.02), Evolution_effect=r(0.005, 0.01),
                     Reference_speed=r(5e-3, 2e-2), Sliding_distance=r(0.005, 0.02), Initial_state=self.chance.choice(("auto", r(0.5, 2))))
        if friction in ("coulomb", "modified coulomb") and self.maybe(0.3):
            self.set("Interface", Viscosity=r(0.1, 5))
        if self.entries["Interface/Law"] == "friction" and friction in ("modified coulomb", "table") and self.maybe(0.5):
            self.set("Interface", Opening_breaks_bond="true")
        if law == "adhesive":
            self.set("Interface/Adhesive", Strength=r(1, 3), Gap_at_strength=r(0.004, 0.01), Adhesive_friction=r(0.2, 1))
            if self.maybe(0.4):
                self.set("Interface/Adhesive", Opening_viscosity=r(0.1, 5))
        if law == "mixed mode":
            self.set("Interface/Mixed mode", Normal_strength=r(1.5, 3), Shear_strength=r(2, 4), Fracture_energy_I=r(0.02, 0.05), Stiffness=r(800, 2000),
                     Fracture_energy_II=r(0.06, 0.1), Criterion=self.chance.choice(("benzeggagh-kenane", "power law")), Exponent=r(1, 2.5))
            if self.maybe(0.4):  # both criteria are one
                self.set("Interface/Mixed mode", Fracture_energy_I=0.07, Fracture_energy_II=0.07, Exponent=1)
        if law == "dilatant":
            self.set("Interface/Dilatant", Height=r(0.0005, 0.002), Length=r(0.03, 0.06))

    def add_bodies(self):
        shape, r, pick = self.what[0].split()[-1] if self.what[0] == "fitted coin" else self.what[0].split()[0], self.number, self.chance.choice
        R, H = r(1.8, 2.8), r(2, 4)
        self.R, self.area = R, math.pi * R * R
        elements = ("trilinear", "quadratic", *(() if self.in_bore or shape in ("ring", "file") else ("spline",)))
        materials = ("rigid", "linear", "linear", "neo-hookean")
        for body, modulus in (("Bone", self.E), ("Implant", 6 * self.E)):
            self.set(body, Material=pick(materials), Element=pick(elements), Poisson_ratio=r(0.2, 0.35), Young_modulus=modulus)
        self.set("Implant", Shape=shape)
        if shape not in ("block", "file"):
            self.set("Implant", Radius=R, Height=H if shape != "cup" else round(R * r(0.7, 1), 4))
        around = pick((8, 12))
        if self.in_bore:
            self.set("Implant", Cells=f"{around}, 1, 2")
            self.set("Bone", Shape="cavity" if shape == "cup" else "sleeve", Cells=f"{around}, {pick((1, 2))}, 2",
                     Ends=pick(("free", "slide", "axial", "held")))
            if self.what[0] == "cup in a block":
                self.set("Bone", Size=f"{3 * R}, {3.4 * R}, {1.8 * R}")
            else:
                self.set("Bone", Outer_radius=round(R * r(1.7, 2.5), 4))
            if shape == "cup":
                self.set("Bone", Cells=f"{around}, 1, 1"), self.set("Implant", Cells=f"{around}, 1, 1")
            elif shape != "screw" and self.maybe(0.3):
                self.set("Bone", Cells=f"{pick((8, 12, 16))}, 1, 3")
                if int(self.entries["Expert/Interface/Quadrature points"]) % 2 and not self.entries["Bone/Cells"].startswith(f"{around},"):
                    self.set("Interface", Quadrature_points=2)  # middles of elements may face a border, where the normal may turn
            if shape == "pin" and self.maybe(0.4):
                self.set("Implant", Inner_radius=round(0.4 * R, 4))
            if shape == "pin" and self.maybe(0.4):
                self.set("Bone", Support_radius=round(1.2 * R, 4), Ends="free")
            if shape == "taper":
                self.set("Implant", Taper_angle=r(2, 6))
            if shape == "screw":
                self.set("Implant", Pitch=round(H / r(1.1, 1.4), 4), Thread_depth=r(0.1, 0.2), Starts=pick((1, 4)), Cells="16, 1, 6")
                self.set("Bone", Cells="16, 1, 6")
            if shape in ("pin", "taper") and self.entries["Implant/Element"] == self.entries["Bone/Element"] == "trilinear" and self.maybe(0.3):
                self.set("Bone", Contact_surface="bilinear")
            self.interference = round(2.2 * self.p / self.eps, 6)
            self.set("Interface", Interference=pick((self.interference, f"{self.interference} * (0.2 + 0.8 * min(t, 1))")))
            return
        self.set("Bone", Size=f"{r(6, 8)}, {r(6, 8)}, {r(2, 4)}", Cells=f"{pick((4, 5))}, {pick((4, 6))}, {pick((1, 2))}")
        if self.entries["Expert/Interface/Slave"] == "bone":  # points on x = 0 may face a border of elements: which one is rounding
            self.entries["Bone/Cells"] = "4" + self.entries["Bone/Cells"][1:]
        if shape == "file":
            self.add_meshes()
        elif self.what[0] == "fitted coin":
            self.set("Implant", Element="spline", Cells="fitted 8, 2, 1"), self.set("Bone", Element="spline", Cells="fitted 8, 2, 2, 2")
        elif shape == "block":
            self.set("Implant", Size=f"{r(3, 5)}, {r(3, 5)}, {H}", Cells=f"{pick((2, 3))}, {pick((2, 4))}, 1")
        elif shape == "ring":
            self.set("Implant", Inner_radius=round(R * r(0.3, 0.5), 4), Cells=f"{around}, 2, 1")
        else:
            self.set("Implant", Cells=f"{pick((3, 4, 5))}, {pick((1, 2))}")
        if shape == "cap":
            self.set("Implant", Cap_radius=r(200, 400))
        if shape not in ("file", "ring") and self.entries["Implant/Element"] == self.entries["Bone/Element"] == "trilinear" and self.maybe(0.3):
            self.set("Bone", Contact_surface="bilinear")
        if self.what[0] not in ("file", "fitted coin"):
            if self.maybe(0.3):
                self.set("Bone", Layer_grading=r(1.2, 1.8))
            if self.maybe(0.3):
                self.set("Bone", Lateral_grading=r(1.1, 1.4))
            if self.entries["Bone/Material"] != "rigid" and self.maybe(0.3):
                self.set("Bone", Young_modulus=f"{self.E} * (1.5 + 0.4 * sin(x / 2 + y / 3) + z / R / 9)")

    def add_meshes(self):
        """A skew prism with a bulged face, on bone whose cells are skew as well, or on a block."""
        r = self.number
        a, b, c, d, h = r(1.5, 2), r(1.5, 2), r(0.05, 0.15), r(-0.15, 0.15), r(2, 3)

        def implant(i, j, k):
            x, y = a * (i - 1.5) / 1.5, b * (j - 1) + c * (i - 1.5)
            return x + d * y, y, h * k + 0.0012 * (1 - k) * (x * x + 0.7 * y * y + 0.2 * x * y)

        def bone(i, j, k):
            x, y = 3.2 * (i - 2) / 2, 3.4 * (j - 2) / 2
            return x + 0.1 * d * (10.24 - x * x) * y, y + c * 0.1 * (11.56 - y * y) * x, 2.5 * (k - 2) / 2

        self.set("Implant", Mesh_file=self.file("implant", Mesh.box((3, 2, 1), implant, {"contact": "bottom", "held": "top"})), Element="trilinear")
        self.area, self.R = 4 * a * b, min(a, b)
        if self.maybe(0.5):
            mesh = Mesh.box((4, 4, 2), bone, {"contact": "top", "held": "bottom", "slides x": "x", "slides y": "y"})
            self.set("Bone", Shape="file", Mesh_file=self.file("bone", mesh), Element="trilinear")
            del self.entries["Bone/Size"], self.entries["Bone/Cells"]

    def add_pattern(self):
        law, r = self.what[1], self.number
        friction = self.entries["Interface/Friction law"]
        is_bonded = law in ("adhesive", "mixed mode") or friction in ("modified coulomb", "table")
        if is_bonded:
            self.set("Interface/Bonding", Bonding_degree=1)
        if self.maybe(0.4) or not is_bonded:
            return
        shape = self.what[0]
        kinds = {"coin": ("disk", "annulus", "random", "image", "expression", "points"), "cap": ("disk", "random", "expression"),
                 "block": ("image", "random", "expression", "points")}.get(shape, ("expression", "homogeneous"))
        pattern = self.chance.choice(kinds)
        self.set("Interface/Bonding", Pattern="file" if pattern == "points" else pattern, Bonding_degree=r(0.6, 1))
        if pattern in ("disk", "annulus", "random"):
            self.set("Interface/Bonding", Bonded_fraction=r(0.3, 0.8))
        if pattern == "random":
            self.set("Interface/Bonding", Seed=self.chance.randrange(100), Correlation_length=self.chance.choice((0, r(0.5, 1.5))))
        if pattern == "expression":
            self.set("Interface/Bonding", Expression="0.5 + 0.4 * sin(1 + 2 * y / R)" if self.on_side else "0.5 + 0.3 * sin(x / R + 2 * y / R) * r / R",
                     Resolution=self.chance.choice(("element", "quadrature point")))
        if pattern == "image":  # borders of pixels are not where points are
            grey = numpy.array([[self.chance.randrange(256) for _ in range(7)] for _ in range(7)])
            self.set("Interface/Bonding", File=self.file("picture", Picture(grey)))
        if pattern == "points":
            places = [[self.chance.uniform(-3, 3) for _ in range(40)] for _ in "xy"]
            self.set("Interface/Bonding", File=self.file("points", Table(x=places[0], y=places[1], phi_0=[self.chance.random() for _ in range(40)])))

    def add_times(self):
        self.times = [0, 1, self.chance.choice((2, 1.5, 3.25))]
        # a bond that breaks in one large step, or a path that turns back in it, has more than one end
        times = 2 if self.what[1] in ("adhesive", "mixed mode") or self.what[2] == "cyclic" else 1
        self.set("Load steps", Times=", ".join(map(str, self.times)), Steps=f"{self.chance.choice((1, 2))}, {times * self.chance.choice((4, 6))}")
        if not self.in_bore and self.entries["Interface/Law"] == "friction" and self.maybe(0.2):
            self.set("Interface", Friction_starts_at=1)

    def add_drive(self):
        drive, r = self.what[2], self.number
        touches_later = self.what[0] in ("cap", "file")  # with no point at first: nothing resists a load
        if drive == "by a moment" and (touches_later or self.entries["Interface/Friction law"] == "frictionless"):
            drive = "by a spring"
        last = self.times[2] - 1
        after = lambda amount: f"{amount} * max(t - 1, 0) / {last}"
        sign = lambda: self.chance.choice((-1, 1))
        depth = r(0.001, 0.003) if self.in_bore else self.p / self.eps * (1.3 if touches_later else 1)
        force, torque = self.p * self.area, 0.35 * self.mu * self.p * self.area * self.R
        loaded = drive == "by a moment" or drive == "tilted" and not self.in_bore
        press = f"{depth:.6g} * (0.2 + 0.8 * min(t, 1))" if loaded and not touches_later else f"{depth:.6g} * min(t, 1)"
        turn, shift = sign() * r(0.5, 3), sign() * r(0.005, 0.06)
        if self.in_bore:
            turn, shift, force = turn / 2, shift / (8 if self.what[1] == "dilatant" else 4), force / 4
        tilt = [sign() * r(0.2, 0.9) * depth / self.R * 57 for _ in "xy"]
        chuck = lambda name, value, **more: self.set(f"Chuck/{name}", Value=value, **more)
        is_held = not (self.in_bore and self.entries["Interface/Friction law"] == "frictionless")
        if is_held and (drive == "by a force" or drive == "by a moment" and self.maybe(0.5)):
            if touches_later:
                chuck("Press", f"{2 * depth:.6g} * min(t, 1)", Stiffness=f"{force / depth:.5g}")
            else:
                chuck("Press", f"{force:.5g} * (0.2 + 0.8 * min(t, 1))", Control="force")
        elif drive == "tables":
            chuck("Press", "table", File=self.file("press", Table(time=[-1, 0, 0.4, 1, 5], value=[0, 0, depth * 0.5, depth, depth * 1.1])),
                  File_columns="time [s], value [mm]")
        elif drive == "pulled" or drive == "all at once":
            pull = r(0.5, 1.3) * (depth if self.what[1] not in ("adhesive", "mixed mode") else 0.01)
            chuck("Translation z", f"{-depth:.6g} * min(t, 1) + {after(f'{pull:.5g}')}")
        else:
            chuck("Press", press)
        if drive in ("twisted", "by a force", "all at once"):
            chuck("Rotation z", after(turn))
        elif drive == "by a moment":
            chuck("Rotation z", after(f"{math.copysign(torque, turn):.5g}"), Control="moment")
        elif drive == "by a spring":
            chuck("Rotation z", after(turn), Stiffness=r(2e3, 2e4))
        elif drive == "cyclic":
            chuck("Rotation z", f"{turn / 3:.5g} * sin(4.3 * max(t - 1, 0) / {last})")
        elif drive == "tables":
            chuck("Rotation z", "table", File=self.file("turn", Table(time=[-1, 1, 2, 5], value=[0, 0, turn, 2.5 * turn])), File_columns="time [s], value [deg]")
        if drive == "sheared":
            more = {"Stiffness": r(1e3, 1e4)} if self.maybe(0.5) else {}
            chuck("Translation x", after(shift), **more), chuck("Translation y", f"{shift / 3} * sin(2 * t)" if self.maybe(0.5) else after(shift * 0.7))
        elif drive == "tilted":
            loaded = not self.in_bore and self.maybe(0.4)
            for axis, angle in zip("xy", tilt):
                moment = math.copysign(min(abs(angle) / depth * self.R / 57, 0.6) * force * self.R / 5, angle)
                chuck(f"Rotation {axis}", after(f"{moment if loaded else angle:.5g}"), **({"Control": "moment"} if loaded else {}))
        elif drive == "all at once":
            for axis, angle, amount in zip("xy", tilt, (shift, -shift / 2)):
                chuck(f"Rotation {axis}", after(f"{angle / 2:.5g}")), chuck(f"Translation {axis}", after(amount))
            self.set("Chuck", Point=f"{r(-1, 1)}, {r(-1, 1)}, {r(3, 6)}")
