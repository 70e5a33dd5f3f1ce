#include <debond/geometry/nurbs_surface.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

namespace Debond
{
  namespace
  {
    /**
     * Tensor product of two sets of univariate B-splines, first index fastest,
     * and, where there are weights, Eq.\ (34) of the paper: R_A = w_A N_A / W
     * with W = sum_B w_B N_B. The derivatives follow from those of R_A W = w_A
     * N_A. The degree is a template argument for the loops to be unrolled.
     */
    template <unsigned int p, class Basis>
    void
    fill_basis(const BernsteinValues     &first,
               const BernsteinValues     &second,
               const std::vector<double> *weights,
               Basis                     &basis)
    {
      constexpr bool second_derivatives = std::is_same_v<Basis, CurvedBasis>;
      constexpr unsigned int n = p + 1, size = n * n;
      basis.size = size;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int k = j * n + i;
            basis.N[k]           = first.B[i] * second.B[j];
            basis.N_1[k]         = first.dB[i] * second.B[j];
            basis.N_2[k]         = first.B[i] * second.dB[j];
            if constexpr (second_derivatives)
              {
                basis.N_11[k] = first.ddB[i] * second.B[j];
                basis.N_12[k] = first.dB[i] * second.dB[j];
                basis.N_22[k] = first.B[i] * second.ddB[j];
              }
          }
      if (weights == nullptr)
        return;

      double W = 0., W_1 = 0., W_2 = 0., W_11 = 0., W_12 = 0., W_22 = 0.;
      for (unsigned int k = 0; k < size; ++k)
        {
          const double w = (*weights)[basis.control_point[k]];
          W += basis.N[k] *= w;
          W_1 += basis.N_1[k] *= w;
          W_2 += basis.N_2[k] *= w;
          if constexpr (second_derivatives)
            {
              W_11 += basis.N_11[k] *= w;
              W_12 += basis.N_12[k] *= w;
              W_22 += basis.N_22[k] *= w;
            }
        }
      const double inverse_W = 1. / W;
      for (unsigned int k = 0; k < size; ++k)
        {
          const double R   = basis.N[k] *= inverse_W;
          const double R_1 = basis.N_1[k] =
            (basis.N_1[k] - R * W_1) * inverse_W;
          const double R_2 = basis.N_2[k] =
            (basis.N_2[k] - R * W_2) * inverse_W;
          if constexpr (second_derivatives)
            {
              basis.N_11[k] =
                (basis.N_11[k] - 2. * R_1 * W_1 - R * W_11) * inverse_W;
              basis.N_12[k] =
                (basis.N_12[k] - R_1 * W_2 - R_2 * W_1 - R * W_12) * inverse_W;
              basis.N_22[k] =
                (basis.N_22[k] - 2. * R_2 * W_2 - R * W_22) * inverse_W;
            }
        }
    }



    /** Makes functions of a triangle of those of its part. */
    template <class Basis>
    void
    extract(const Eigen::Matrix<double, 6, 9> &E, Basis &basis)
    {
      const auto combine = [&E](auto &N) {
        Eigen::Map<Eigen::Matrix<double, 6, 1>>(N.data()) =
          (E * Eigen::Map<Eigen::Matrix<double, 9, 1>>(N.data())).eval();
      };
      combine(basis.N);
      combine(basis.N_1);
      combine(basis.N_2);
      if constexpr (std::is_same_v<Basis, CurvedBasis>)
        {
          combine(basis.N_11);
          combine(basis.N_12);
          combine(basis.N_22);
        }
      basis.size = E.rows();
    }
  } // namespace



  NurbsSurface::NurbsSurface(const KnotVector          &knots_1,
                             const KnotVector          &knots_2,
                             const ControlNet          &control_points,
                             const std::vector<double> &weights)
    : knot_vectors{{knots_1, knots_2}}
    , points(control_points)
    , weight(weights)
  {
    assert(knots_1.n_spans() > 0 && knots_2.n_spans() > 0 &&
           knots_1.degree() == knots_2.degree());
    assert(points.cols() == Eigen::Index(weight.size()) &&
           weight.size() ==
             knots_1.n_basis_functions() * knots_2.n_basis_functions());
    const Eigen::Map<const Eigen::ArrayXd> w(weight.data(), weight.size());
    if (!points.allFinite() || !w.allFinite() || !(w > 0.).all())
      throw std::invalid_argument(
        "Control points and weights must be finite, and weights positive.");
    is_rational = (w != 1.).any();
  }



  unsigned int
  NurbsSurface::n_elements_across() const
  {
    return is_one_patch() ?
             std::min(knot_vectors[0].n_spans(), knot_vectors[1].n_spans()) :
             n_in_row;
  }



  unsigned int
  NurbsSurface::element_of(const Eigen::Vector2d &xi) const
  {
    // span_of() returns the first or last span beyond the ends: clamped.
    if (is_one_patch())
      return knot_vectors[1].span_of(xi[1]) * knot_vectors[0].n_spans() +
             knot_vectors[0].span_of(xi[0]);
    const auto index = [&](const unsigned int d) -> unsigned int {
      return std::clamp(std::floor(0.5 * (xi[d] + 0.5)), 0., n_in_row - 1.);
    };
    return std::min<unsigned int>(index(0) + n_in_row * index(1),
                                  faces.size() - 1);
  }



  std::array<Eigen::Vector2d, 2>
  NurbsSurface::element_bounds(const unsigned int element) const
  {
    assert(element < n_elements());
    if (!is_one_patch())
      {
        const Eigen::Vector2d lowest = lowest_of_face(element);
        return {{lowest, lowest + Eigen::Vector2d::Ones()}};
      }
    const unsigned int n = knot_vectors[0].n_spans();
    const double      *u = knot_vectors[0].breakpoints().data() + element % n;
    const double      *v = knot_vectors[1].breakpoints().data() + element / n;
    return {{Eigen::Vector2d(u[0], v[0]), Eigen::Vector2d(u[1], v[1])}};
  }



  Eigen::Vector2d
  NurbsSurface::clamped(const Eigen::Vector2d &xi) const
  {
    const Eigen::Vector2d lowest = is_one_patch() ?
                                     Eigen::Vector2d::Zero().eval() :
                                     lowest_of_face(element_of(xi));
    return xi.cwiseMax(lowest).cwiseMin(lowest + Eigen::Vector2d::Ones());
  }



  void
  KeptBasis::move_to(const NurbsSurface    &new_surface,
                     const Eigen::Vector2d &new_xi)
  {
    if (surface == &new_surface && xi == new_xi)
      return;
    new_surface.evaluate(new_xi, static_cast<SurfaceBasis &>(*this));
    surface = &new_surface;
    xi      = new_xi;
  }



  // B-splines of both parameters. Those of a face are functions of a parameter
  // of its own, which runs from 0 to 1.
  template <class Basis>
  void
  NurbsSurface::evaluate_in_element(const unsigned int     element,
                                    const Eigen::Vector2d &xi,
                                    Basis                 &basis) const
  {
    assert(element < n_elements());
    const auto splines = [&](const unsigned int d) -> BernsteinValues {
      if (is_one_patch())
        {
          const unsigned int n = knot_vectors[0].n_spans();
          return knot_vectors[d].evaluate(d == 0 ? element % n : element / n,
                                          xi[d]);
        }
      const Face       &face  = faces[element];
      const KnotVector &knots = patch_knots[face.patch][d];
      const double     *ends  = &knots.breakpoints()[face.span[d]];
      const double      width = ends[1] - ends[0];
      BernsteinValues   result =
        knots.evaluate(face.span[d],
                       ends[0] + (xi[d] - lowest_of_face(element)[d]) * width);
      result.dB *= width;
      result.ddB *= width * width;
      return result;
    };
    basis.element             = element;
    basis.control_point       = element_control_points(element);
    const auto *const weights = is_rational ? &weight : nullptr;
    (degree() == 2 ?
       fill_basis<2, Basis> :
       fill_basis<1, Basis>)(splines(0), splines(1), weights, basis);
    if (has_triangles())
      extract(extraction[faces[element].first_corner], basis);
  }

  template void
  NurbsSurface::evaluate_in_element(unsigned int,
                                    const Eigen::Vector2d &,
                                    SurfaceBasis &) const;
  template void
  NurbsSurface::evaluate_in_element(unsigned int,
                                    const Eigen::Vector2d &,
                                    CurvedBasis &) const;



  std::array<unsigned int, SurfaceBasis::max_size>
  NurbsSurface::element_control_points(const unsigned int element) const
  {
    assert(element < n_elements());
    std::array<unsigned int, SurfaceBasis::max_size> result{};
    if (!is_one_patch())
      {
        std::copy(faces[element].control_points.begin(),
                  faces[element].control_points.end(),
                  result.begin());
        return result;
      }
    const unsigned int n = knot_vectors[0].n_spans();
    const unsigned int first_1 =
      knot_vectors[0].first_basis_function(element % n);
    const unsigned int first_2 =
      knot_vectors[1].first_basis_function(element / n);
    const unsigned int stride = knot_vectors[0].n_basis_functions();
    const unsigned int p      = degree();

    unsigned int k = 0;
    for (unsigned int j = 0; j <= p; ++j)
      for (unsigned int i = 0; i <= p; ++i)
        result[k++] = (first_2 + j) * stride + first_1 + i;
    return result;
  }



  Eigen::Vector3d
  NurbsSurface::point(const Eigen::Vector2d &xi) const
  {
    SurfaceBasis basis;
    evaluate(xi, basis);
    return interpolate(basis, points);
  }



  bool
  NurbsSurface::is_flat() const
  {
    const Eigen::Matrix3Xd from_centre =
      points.colwise() - points.rowwise().mean();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(
      from_centre * from_centre.transpose());
    const auto heights = axes.eigenvectors().col(0).transpose() * from_centre;
    return heights.cwiseAbs().maxCoeff() <
           1e-12 * from_centre.cwiseAbs().maxCoeff();
  }
} // namespace Debond
