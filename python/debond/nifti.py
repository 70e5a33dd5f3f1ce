"""NIfTI images as MetaImage, which debond reads: python3 -m debond nifti FILE.nii FILE.mha."""

import os

import nibabel
import numpy

from .errors import InputError
from .files import say

UNITS = {"mm": 1.0, "meter": 1e3, "micron": 1e-3, "unknown": 1.0}  # [mm]


def _place_of_voxels(header, refuse) -> numpy.ndarray:
    """Columns: steps of the indices and the first voxel (3, 4), x to the left and y to the back, in the unit of the file.
    Where a header has neither qform nor sform it knows of no body: the indices run along x, y and z."""
    qform, sform = (form(coded=True)[0] for form in (header.get_qform, header.get_sform))
    if qform is None and sform is None:
        return numpy.hstack([numpy.diag(numpy.asarray(header["pixdim"][1:4], dtype=float)), numpy.zeros((3, 1))])
    affine = (qform if sform is None else sform)[:3]
    if qform is not None and sform is not None:
        farthest = (numpy.abs(sform - qform)[:3] @ [*header.get_data_shape()[:3], 1.0]).max()
        voxels = farthest / numpy.linalg.norm(sform[:3, :3], axis=0).min()
        if not voxels <= 0.01:
            refuse(f"its qform and its sform differ, by {voxels:.3g} voxels at most: set the code of the one that is wrong to 0")
        affine = qform[:3]
    return numpy.array([[-1.0], [-1.0], [1.0]]) * affine


def as_meta_image(filename) -> bytes:
    """A MetaImage (.mha) of a NIfTI image of one volume, .nii or .nii.gz, version 1 or 2: scaled grey values, and where the
    voxels are [mm], x to the left of the body, y to its back, z to its head. Raises InputError."""
    filename = os.fspath(filename)

    def refuse(why):
        raise InputError.of_entry("FILE.nii", why, filename)

    try:
        image = nibabel.load(filename)
        if not isinstance(image, nibabel.Nifti1Image):
            refuse("it is no NIfTI image")
        grey = numpy.asarray(image.dataobj, dtype="<f4")
        place = _place_of_voxels(image.header, refuse)
        unit = UNITS[image.header.get_xyzt_units()[0]]
    except InputError:
        raise
    except Exception as error:  # of many kinds, from the compression on
        refuse(f"it cannot be read: {error}")
    if grey.ndim < 3 or max(grey.shape[3:], default=1) > 1:
        refuse(f"it has {' x '.join(map(str, grey.shape))} values: expected one image of three dimensions")
    edges = numpy.linalg.norm(place[:, :3], axis=0)
    if not (edges > 0).all() or not numpy.isfinite(place).all():
        refuse(f"it has voxels of {edges}: expected more than 0")
    text = lambda numbers: " ".join(repr(float(number)) for number in numbers)
    header = ["ObjectType = Image", "NDims = 3", "BinaryData = True", "BinaryDataByteOrderMSB = False",
              f"TransformMatrix = {text((place[:, :3] / edges).T.ravel())}", f"Offset = {text(unit * place[:, 3])}",
              f"ElementSpacing = {text(unit * edges)}", f"DimSize = {' '.join(map(str, grey.shape[:3]))}",
              "ElementType = MET_FLOAT", "ElementDataFile = LOCAL"]
    return "\n".join([*header, ""]).encode() + grey.tobytes(order="F")


def main(filename: str, image: str, options) -> int:
    """Writes the image; returns the exit code."""
    content = as_meta_image(filename)
    with open(image, "wb") as file:
        file.write(content)
    say(f"{image} written")
    return 0
