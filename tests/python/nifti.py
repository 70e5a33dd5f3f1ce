"""NIfTI images become MetaImages of the same specimen, whose grey value is a linear function of the place: in 48 orders of
storage, both versions and orders of bytes, by qform, sform and both. What contradicts itself is refused."""

import gzip
import itertools
import sys

import nibabel
import numpy

from debond.errors import InputError
from debond.nifti import as_meta_image

N, EDGE, LOWEST = numpy.array([4, 3, 2]), numpy.array([0.5, 1.0, 2.0]), numpy.array([-1.5, 2.0, -7.0])  # [mm], centre
TO_BODY = numpy.array([-1.0, -1.0, 1.0])  # x to the right and y to the front of NIfTI
failed = []


def expect(is_so, what):
    if not is_so:
        failed.append(what)
        print(f"{what}: NO")


def grey_at(place):
    return 100.0 + place @ [8.0, 20.0, 4.0]


def stored(axes=(0, 1, 2), signs=(1, 1, 1)):
    """Grey values in this order, and the affine of NIfTI."""
    steps = numpy.zeros((3, 3))
    for index, (axis, sign) in enumerate(zip(axes, signs)):
        steps[axis, index] = sign * EDGE[axis]
    first = LOWEST + sum((N[axis] - 1) * EDGE[axis] * numpy.eye(3)[axis] for axis, sign in zip(axes, signs) if sign < 0)
    index = numpy.moveaxis(numpy.indices(N[list(axes)]), 0, -1)
    affine = numpy.eye(4)
    affine[:3] = TO_BODY[:, None] * numpy.column_stack([steps, first])
    return grey_at(first + index @ steps.T), affine


def error_of(content):
    """The largest difference of a MetaImage from the specimen."""
    *lines, values = content.split(b"\n", 10)
    header = dict(line.decode().split(" = ") for line in lines)
    numbers = lambda name: numpy.array(header[name].split(), dtype=float)
    shape = numbers("DimSize").astype(int)
    directions = numbers("TransformMatrix").reshape(3, 3).T
    if abs(directions - directions.round()).max() > 1e-3:  # which a scene allows, and rounds
        return numpy.inf
    steps = directions.round() * numbers("ElementSpacing")
    grey = numpy.frombuffer(values, "<f4").reshape(shape, order="F")
    places = numbers("Offset") + numpy.moveaxis(numpy.indices(shape), 0, -1) @ steps.T
    ends = abs(places.reshape(-1, 3).min(0) - LOWEST).max() + abs(places.reshape(-1, 3).max(0) - LOWEST - (N - 1) * EDGE).max()
    return max(abs(grey - grey_at(places)).max(), ends)


def image(grey, affine, forms=("sform",), kind=nibabel.Nifti1Image, order="<", unit="mm"):
    header = kind.header_class(endianness=order)
    header.set_data_dtype(numpy.float32)
    one = kind(grey, None, header)
    one.header["pixdim"][1:4] = numpy.linalg.norm(affine[:3, :3], axis=0)
    one.set_sform(affine if "sform" in forms else None, 1 if "sform" in forms else 0)
    one.set_qform(affine if "qform" in forms else None, 1 if "qform" in forms else 0)
    one.header.set_xyzt_units(unit)
    nibabel.save(one, "image.nii")
    return "image.nii"


def patched(name, at, *numbers):
    """The file of version 1 with other numbers in its header."""
    with open(name, "r+b") as file:
        file.seek(at)
        file.write(numpy.array(numbers, "<f4").tobytes())
    return name


def refused(name, words, what):
    try:
        as_meta_image(name)
        expect(False, f"{what} is refused")
    except InputError as error:
        expect(words in str(error), f"{what}: {error}")


worst = 0.0
for axes, signs in itertools.product(itertools.permutations(range(3)), itertools.product((1, -1), repeat=3)):
    for forms, kind, order in itertools.product((("sform",), ("qform",), ("qform", "sform")), (nibabel.Nifti1Image, nibabel.Nifti2Image), "<>"):
        worst = max(worst, error_of(as_meta_image(image(*stored(axes, signs), forms, kind, order))))
expect(worst < 1e-4, f"48 orders: {worst}")

grey, affine = stored()
for unit, factor in (("micron", 1e3), ("meter", 1e-3), ("unknown", 1.0)):
    expect(error_of(as_meta_image(image(grey, numpy.diag([factor] * 3 + [1]) @ affine, unit=unit))) < 1e-4, unit)
expect(error_of(as_meta_image(image(grey[..., None], affine))) < 1e-4, "a fourth dimension of 1")
scaled = patched(image(2 * (grey - 50), affine), 112, 0.5, 50.0)  # scl_slope, scl_inter
expect(error_of(as_meta_image(scaled)) < 1e-4, "slope and intercept")
with open(image(grey, affine), "rb") as file, open("packed.nii.gz", "wb") as packed:
    whole = file.read()
    packed.write(gzip.compress(whole))
expect(error_of(as_meta_image("packed.nii.gz")) < 1e-4, "packed")
bare = as_meta_image(image(grey, affine, ()))
expect(b"Offset = 0.0 0.0 0.0\n" in bare and b"TransformMatrix = 1.0 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0\n" in bare, "neither qform nor sform")

shifted = patched(image(grey, affine, ("qform", "sform")), 308, affine[1, 3] + 0.1)  # the end of srow_y
refused(shifted, "its qform and its sform differ, by 0.2 voxels", "forms that differ")
refused(image(numpy.stack([grey, grey], -1), affine), "4 x 3 x 2 x 2 values", "two images")
refused(image(grey[..., 0], affine), "4 x 3 values", "a plane")
for content, what in ((whole[:300], "cut off in its header"), (whole[:-8], "cut off in its data"), (b"", "an empty file")):
    with open("wrong.nii", "wb") as file:
        file.write(content)
    refused("wrong.nii", "it cannot be read", what)
packed = gzip.compress(whole)
with open("wrong.nii.gz", "wb") as file:
    file.write(packed[:len(packed) // 2])
refused("wrong.nii.gz", "it cannot be read", "packed, cut off")
refused("nowhere.nii", "it cannot be read", "no file")
sys.exit(1 if failed else 0)
