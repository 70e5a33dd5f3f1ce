#include <debond/geometry/surface_geometry.h>
#include <debond/interface/interface_parameters.h>
#include <debond/shapes/body_parameters.h>
#include <debond/shapes/faces_of_mesh.h>
#include <debond/system/press_fit.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    /** Of control points that make nodes of the faces move by these. */
    ControlNet
    control_points_of(const ControlNet &nodes, const NurbsSurface &face)
    {
      ControlNet result = nodes;
      if (face.degree() == 1 || face.has_triangles())
        return result;
      for (unsigned int element = 0; element < face.n_elements(); ++element)
        {
          const auto       points = face.element_control_points(element);
          Eigen::Matrix3Xd v(3, 9);
          for (unsigned int k = 0; k < 9; ++k)
            v.col(k) = nodes.col(points[k]);
          interpolate_nodes(v);
          for (unsigned int k = 0; k < 9; ++k)
            result.col(points[k]) = v.col(k);
        }
      return result;
    }



    /** Of each node of the faces the shortest way by which all that meet there
     *  stand out by 1, whatever their normals n: n . v = 1, by least squares
     *  where these are nearly the same. */
    ControlNet
    outwards_of(const NurbsSurface &face)
    {
      std::vector<std::vector<Eigen::Vector3d>> normals(
        face.n_control_points());
      // of a triangle each part has three of the nodes, at corners
      const unsigned int p = face.has_triangles() ? 1 : face.degree();
      for (unsigned int element = 0; element < face.n_elements(); ++element)
        for (unsigned int k = 0; k < (p + 1) * (p + 1); ++k)
          {
            const Eigen::Vector2d at(double(k % (p + 1)) / p,
                                     double(k / (p + 1)) / p);
            SurfaceBasis          basis;
            SurfaceGeometry       geometry;
            face.evaluate_in_element(element,
                                     face.element_bounds(element)[0] + at,
                                     basis);
            contract(basis, face.control_points(), geometry);
            unsigned int node = k;
            if (face.has_triangles())
              node = std::max_element(basis.N.begin(),
                                      basis.N.begin() + basis.size) -
                     basis.N.begin();
            if (face.has_triangles() && basis.N[node] < 0.9)
              continue; // the middle of the triangle
            normals[basis.control_point[node]].push_back(
              -geometry.a1.cross(geometry.a2).normalized());
          }
      ControlNet result(3, normals.size());
      for (unsigned int A = 0; A < normals.size(); ++A)
        {
          Eigen::MatrixXd n(normals[A].size(), 3);
          for (unsigned int i = 0; i < normals[A].size(); ++i)
            n.row(i) = normals[A][i];
          Eigen::JacobiSVD<Eigen::MatrixXd> svd(n,
                                                Eigen::ComputeThinU |
                                                  Eigen::ComputeThinV);
          svd.setThreshold(0.3); // below that they are one normal
          result.col(A) = svd.solve(Eigen::VectorXd::Ones(n.rows()));
        }
      return control_points_of(result, face);
    }
  } // namespace



  PressFit::PressFit(const InterfaceParameters &interface,
                     const BodyParameters      &implant,
                     const NurbsSurface        &face)
    : outwards(3, 0)
  {
    if (!interface.has_interference())
      return;
    // A thicker implant is one whose face stands further out by half of the
    // interference, in the direction of BodyGeometry::outwards(), or of the
    // normals of a file: control points move, and the face with them.
    interference = read_time_function(interface.interference,
                                      implant.characteristic_radius());
    if (implant.shape == BodyShape::file)
      {
        outwards = outwards_of(face);
        return;
      }
    const auto &X = face.control_points();
    outwards.resize(3, X.cols());
    for (unsigned int A = 0; A < X.cols(); ++A)
      outwards.col(A) = implant.geometry().outwards(X.col(A));
  }



  void
  PressFit::set(const double time)
  {
    if (!is_none())
      half = 0.5 * interference(time);
  }



  // Forces are those of the residual, which hold the face back.
  void
  PressFit::commit(const ControlNet &forces)
  {
    if (is_none())
      return;
    // conjugate to `half': work per thickness, over all control points [N]
    const double force = forces.cwiseProduct(outwards).sum();
    work += 0.5 * (accepted_force + force) * (half - accepted_half);
    bound += 0.5 * std::abs((force - accepted_force) * (half - accepted_half));
    accepted_force = force;
    accepted_half  = half;
  }
} // namespace Debond
