"""What the scripts beside this one share: the file of Gmsh that a body comes from."""


def write(name, nodes, elements, digits):
    """Nodes are places [mm], with so many digits; elements pairs of texts and nodes, from 1. A text has Gmsh's type, and the
    physical group twice: 1 contact, 2 held, 3 bone."""
    with open(name, 'w') as out:
        out.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n')
        out.write('$PhysicalNames\n3\n2 1 "contact"\n2 2 "held"\n3 3 "bone"\n$EndPhysicalNames\n')
        out.write('$Nodes\n%d\n' % len(nodes))
        for k, x in enumerate(nodes):
            out.write('%d %s\n' % (k + 1, ' '.join('%.*g' % (digits, value) for value in x)))
        out.write('$EndNodes\n$Elements\n%d\n' % len(elements))
        for k, (kind, corners) in enumerate(elements):
            out.write('%d %s %s\n' % (k + 1, kind, ' '.join(map(str, corners))))
        out.write('$EndElements\n')
