#pragma once

#include <debond/geometry/nurbs_surface.h>

/** A rectangle around the origin of n1 x n2 elements. */
inline Debond::NurbsSurface
rectangle_of(const double       lx,
             const double       ly,
             const unsigned int n1,
             const unsigned int n2,
             const unsigned int degree  = 2,
             const double       grading = 1)
{
  using Debond::KnotVector;
  return Debond::NurbsSurface::rectangle(
    lx,
    ly,
    KnotVector::graded(degree, n1, grading),
    KnotVector::graded(degree, n2, grading));
}
