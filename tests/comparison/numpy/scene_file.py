"""Reads the scene files (.prm) of debond, as far as this solver knows what they ask for.

An entry that is not in the table below, or has a value beyond what the solver can do, is an error: nothing that a scene
says is passed over.
"""
import math

import numpy as np

import friction
import interface
import joint
import simulation
import solids

FREE_TEXT = object()  # entries that say nothing about the mechanics

# Defaults of debond, from `debond --print-parameters`; a tuple holds all values that the solver
# knows, the default first.
BODY = {'{}/Element': ('trilinear',), 'Expert/{}/Layer grading': 1., '{}/Material': ('neo-hookean', 'linear'), '{}/Poisson ratio': .3,
        'Expert/{}/Contact surface': ('nurbs',)}
ENTRIES = {
    'Title': FREE_TEXT, 'Accuracy': ('none',), 'Model': ('finite elements',), 'Task': ('simulate',),
    **{name.format('Bone'): value for name, value in BODY.items()},
    'Bone/Size': [12.5, 12.5, 5.], 'Bone/Cells': [15., 15., 2.], 'Bone/Young modulus': 18000.,
    'Expert/Bone/Lateral grading': ('1',), 'Expert/Bone/Cells under implant': ('none',), 'Expert/Bone/Rim grading': ('1.5',),
    **{name.format('Implant'): value for name, value in BODY.items()},
    'Implant/Shape': ('coin',), 'Implant/Radius': 2.5, 'Implant/Height': 3., 'Implant/Cells': [3., 2.],
    'Implant/Young modulus': 113000.,
    'Expert/Interface/Slave': ('implant', 'bone'), 'Expert/Interface/Quadrature points': 5.,
    'Interface/Normal stiffness': 585., 'Interface/Tangential stiffness': 'auto',
    'Interface/Friction law': ('modified coulomb', 'coulomb', 'frictionless', 'table', 'rate and state'),
    'Interface/Friction coefficient': .4, 'Interface/Friction coefficient broken': .4, 'Interface/Friction coefficient unbroken': .58,
    'Interface/Characteristic slip distance': .022, 'Interface/Transition factor': .74, 'Interface/Friction starts at': -np.inf,
    'Expert/Slip direction': ('integrated', 'trial'),
    'Interface/Opening breaks bond': ('false',), 'Interface/Viscosity': 0., 'Interface/Friction table': 'none',
    'Interface/Rate and state/Reference coefficient': .4, 'Interface/Rate and state/Direct effect': .01,
    'Interface/Rate and state/Evolution effect': .015, 'Interface/Rate and state/Reference speed': 1e-3,
    'Interface/Rate and state/Sliding distance': .01, 'Interface/Rate and state/Initial state': 'auto',
    'Expert/Interface/Rate and state/Evolution': ('ageing', 'slip'),
    'Interface/Law': ('friction', 'adhesive', 'mixed mode', 'dilatant'),
    'Interface/Adhesive/Strength': 0., 'Interface/Adhesive/Gap at strength': 1.,
    'Interface/Adhesive/Adhesive friction': 0.,
    'Interface/Dilatant/Height': 0., 'Interface/Dilatant/Length': 1.,
    **{'Interface/Mixed mode/' + name: 1. for name in ('Normal strength', 'Shear strength', 'Fracture energy I',
                                                       'Fracture energy II', 'Stiffness')},
    'Expert/Interface/Mixed mode/Exponent': 1.,
    'Interface/Mixed mode/Criterion': ('benzeggagh-kenane', 'power law'),
    'Interface/Bonding/Pattern': ('homogeneous', 'expression'), 'Interface/Bonding/Bonding degree': 1.,
    'Expert/Interface/Bonding/Resolution': ('element', 'quadrature point'), 'Interface/Bonding/Expression': '1',
    'Load steps/Times': [0., 1., 2.], 'Load steps/Steps': [1., 1000.], 'Load steps/Adaptive': ('false',),
    'Expert/Load steps/Residual tolerance': 1e-8,
    **{name: FREE_TEXT for name in ('Output/Directory', 'Output/Fields every', 'Expert/Output/Console', 'Expert/Output/Checkpoint every')},
}
COMPONENTS = ['%s %s' % (kind, axis) for kind in ('Translation', 'Rotation') for axis in 'xyz']
PRESS = 'Chuck/Press/Value'  # into the bone, instead of Translation z
for component in [*COMPONENTS, 'Press']:
    ENTRIES['Chuck/%s/Value' % component] = '0'
    ENTRIES['Chuck/%s/Control' % component] = ('angle',) if component[0] == 'R' else ('displacement',)

FUNCTIONS = {name: getattr(np, name) for name in ('sin', 'cos', 'tan', 'sqrt', 'exp', 'abs')}
FUNCTIONS.update(pi=np.pi, min=np.minimum, max=np.maximum)


class NotSupported(ValueError):
    """The scene asks for what this solver cannot do."""


def _statements(path):
    """Pairs of entry, 'Subsection/Name', and value."""
    sections = []
    with open(path, encoding='utf-8') as lines:
        for line in lines:
            line = line.partition('#')[0].strip()
            if line.startswith('subsection '):
                sections.append(line[len('subsection '):].strip())
            elif line == 'end':
                sections.pop()
            elif line.startswith('set '):
                name, _, value = line[len('set '):].partition('=')
                yield '/'.join(sections + [name.strip()]), value.strip()
            elif line:
                raise NotSupported('%s: "%s"' % (path, line))


def _value(name, text):
    """The value of an entry as a number, a list of numbers or a text."""
    known = ENTRIES.get(name)
    if known is None or (isinstance(known, tuple) and text not in known):
        raise NotSupported('this solver does not know "%s = %s"' % (name, text))
    if isinstance(known, float):
        return float(text)
    if isinstance(known, list):
        return [float(number) for number in text.split(',')]
    return text


def read_entries(path, changes=()):
    """Values of all entries of the table by name; changes are texts 'Entry=value' that override the scene."""
    values = {name: default[0] if isinstance(default, tuple) else default
              for name, default in ENTRIES.items()}
    for name, text in list(_statements(path)) + [change.split('=', 1) for change in changes]:
        values[name] = _value(name, text)
    return values


def _expression(text, **constants):
    """A function of keyword arguments from an expression of muParser."""
    code = compile(text.replace('^', '**'), text, 'eval')
    return lambda **variables: eval(code, {'__builtins__': {}}, {**FUNCTIONS, **constants, **variables})


def _whole(numbers):
    return [int(number) for number in numbers]


class Scene:
    """A scene: the planned times and the simulation that goes through them."""

    def __init__(self, path, changes=()):
        self.entries = read_entries(path, changes)
        self.radius, self.height = self.entries['Implant/Radius'], self.entries['Implant/Height']
        self.times = self._times()
        self.motion = [_expression(self.entries['Chuck/%s/Value' % name], R=self.radius) for name in COMPONENTS]
        self.press = _expression(self.entries[PRESS], R=self.radius)

    def _times(self):
        """All planned times, the first one included."""
        ends, steps = self.entries['Load steps/Times'], _whole(self.entries['Load steps/Steps'])
        if len(steps) != len(ends) - 1:
            raise NotSupported('%d phases have %d numbers of steps' % (len(ends) - 1, len(steps)))
        phases = [np.linspace(a, b, n + 1)[1:] for a, b, n in zip(ends, ends[1:], steps)]
        return np.concatenate([ends[:1]] + phases)

    def components(self, time):
        """The chuck at a time: translations x, y, z [mm], rotations x, y, z [rad]."""
        values = [float(component(t=time)) for component in self.motion]
        values[2] -= float(self.press(t=time))
        return values[:3] + [math.radians(angle) for angle in values[3:]]

    def _bone(self):
        get = self.entries.get
        nx, ny, nz = _whole(get('Bone/Cells'))
        if nx != ny:
            raise NotSupported('as many cells of the bone in x as in y')
        return solids.bone_block(get('Bone/Size'), (nx, nz), get('Expert/Bone/Layer grading'), get('Bone/Young modulus'),
                                 get('Bone/Poisson ratio'), get('Bone/Material'))

    def _implant(self):
        get = self.entries.get
        return solids.coin(self.radius, self.height, _whole(get('Implant/Cells')), get('Expert/Implant/Layer grading'),
                           get('Implant/Young modulus'), get('Implant/Poisson ratio'), get('Implant/Material'))

    def _friction_law(self):
        get = self.entries.get
        law = get('Interface/Friction law')
        if law == 'rate and state':
            names = ('Reference coefficient', 'Direct effect', 'Evolution effect', 'Reference speed',
                     'Sliding distance', 'Initial state')
            values = [get('Interface/Rate and state/' + name) for name in names]
            values[-1] = 0. if values[-1] == 'auto' else float(values[-1])
            return friction.RateAndState(*values,
                                         get('Expert/Interface/Rate and state/Evolution') == 'ageing')
        broken, unbroken = (get('Interface/Friction coefficient ' + name) for name in ('broken', 'unbroken'))
        if law == 'table':
            rows = np.genfromtxt(get('Interface/Friction table'), delimiter=',', names=True)
            return friction.Table(unbroken, broken, rows['slip_mm'], rows['phi'])
        if law == 'coulomb':
            broken = unbroken = get('Interface/Friction coefficient')
        return friction.ModifiedCoulomb(unbroken, broken,
                                        get('Interface/Characteristic slip distance'), get('Interface/Transition factor'))

    def _tangential_stiffness(self):
        text = self.entries['Interface/Tangential stiffness']
        return self.entries['Interface/Normal stiffness'] if text == 'auto' else float(text)

    def _law(self):
        get = self.entries.get
        law, friction_law = get('Interface/Law'), self._friction_law()
        normal = get('Interface/Normal stiffness')
        stiffness = normal, self._tangential_stiffness()
        if law == 'friction':
            return joint.Friction(friction_law, stiffness)
        if get('Interface/Friction law') == 'rate and state':
            raise NotSupported('rate and state needs Law = friction')
        if law == 'dilatant':
            return joint.Dilatant(friction_law, stiffness, *(get('Interface/Dilatant/' + name)
                                                             for name in ('Height', 'Length')))
        if law == 'mixed mode':
            normal, shear, first, second, initial = (get('Interface/Mixed mode/' + name) for name in (
                'Normal strength', 'Shear strength', 'Fracture energy I', 'Fracture energy II', 'Stiffness'))
            exponent = get('Expert/Interface/Mixed mode/Exponent')
            power_law = get('Interface/Mixed mode/Criterion') == 'power law'
            return joint.MixedMode(friction_law, stiffness, (normal, shear), (first, second), initial, power_law,
                                   exponent)
        return joint.Adhesive(friction_law, stiffness, *(get('Interface/Adhesive/' + name) for name in (
            'Strength', 'Gap at strength', 'Adhesive friction')))

    def _bonding(self):
        """phi_0 as a function of x, y (m,) [mm]."""
        get = self.entries.get
        homogeneous = get('Interface/Bonding/Pattern') == 'homogeneous'
        if not homogeneous and get('Expert/Interface/Bonding/Resolution') != 'quadrature point':
            raise NotSupported('an expression of the bonding needs Resolution = quadrature point')
        if not homogeneous and get('Expert/Interface/Slave') == 'bone':
            raise NotSupported('an expression of the bonding needs Slave = implant')
        expression = _expression('1' if homogeneous else get('Interface/Bonding/Expression'), R=self.radius)
        factor = get('Interface/Bonding/Bonding degree')
        return lambda x, y: factor * expression(x=x, y=y, r=np.hypot(x, y), angle=np.degrees(np.arctan2(y, x)))

    def simulation(self):
        get = self.entries.get
        bone, implant = self._bone(), self._implant()
        slave, master, towards = (implant, bone, +1) if get('Expert/Interface/Slave') == 'implant' else (bone, implant, -1)
        points = int(get('Expert/Interface/Quadrature points'))
        contact = interface.Interface(slave, master, towards, self._law(), points, self._bonding(), get('Interface/Viscosity'),
                                      get('Expert/Slip direction') == 'integrated')
        area = interface.face_quadrature(implant, points)[1].sum()
        return simulation.Simulation(bone, implant, contact, area, self.height, get('Expert/Load steps/Residual tolerance'))

    def _friction(self, time):
        """Whether a step that begins at this time has friction."""
        return (self.entries['Interface/Friction law'] != 'frictionless'
                and time >= self.entries['Interface/Friction starts at'] - 1e-12)

    def run(self):
        """Yields the results of the first time and of every planned step."""
        solver = self.simulation()
        begins = np.concatenate([self.times[:1], self.times[:-1]])
        for number, (begin, time) in enumerate(zip(begins, self.times)):
            if number:
                solver.step(self.components(time), self._friction(begin), time - begin)
            else:
                solver.start(self.components(time), self._friction(begin))
            yield {'step': number, 'time': time, 'iterations': solver.iterations, **solver.results()}
