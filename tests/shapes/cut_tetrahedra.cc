// Tetrahedra cut into hexahedra: a ball of radius 1 in eight tetrahedra of ten
// nodes, six of which are moved outwards, as .inp and .msh. Volume and area
// are those of the tetrahedra, by their own functions and products of Gauss'
// rules. Of four nodes: the octahedron, 4/3 and 4 sqrt(3), whose faces are
// pieces.

#include <debond/bulk/bulk_space.h>
#include <debond/shapes/mesh_builder.h>

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Geometry>

#include <fstream>
#include <stdexcept>

#include "checks.h"

using namespace Debond;
using Eigen::Vector3d;

/** Vertices, then the middles of the edges of StoredMesh. */
using Tetrahedron = std::array<Vector3d, 10>;

std::vector<Tetrahedron>
ball()
{
  std::vector<Tetrahedron> result;
  for (const double z : {1., -1.})
    for (unsigned int k = 0; k < 4; ++k)
      {
        const auto around = [&](const unsigned int i) {
          return Vector3d(std::round(std::cos(M_PI / 2 * i)),
                          std::round(std::sin(M_PI / 2 * i)),
                          0.);
        };
        Tetrahedron t{
          {Vector3d::Zero(), around(k), around(k + 1), Vector3d(0, 0, z)}};
        for (unsigned int e = 0; e < 6; ++e)
          {
            const auto &[i, j] = StoredMesh::edges[e];
            t[4 + e]           = 0.5 * (t[i] + t[j]);
            if (i > 0)
              t[4 + e].normalize();
          }
        result.push_back(t);
      }
  return result;
}

/** Derivatives of the place in a tetrahedron by the last three of its
 * barycentric coordinates, at this place. */
Eigen::Matrix3d
jacobian(const Tetrahedron &x, const Eigen::Vector4d &w, const bool is_curved)
{
  Eigen::Matrix<double, 3, 4> by_w;
  for (unsigned int v = 0; v < 4; ++v)
    by_w.col(v) = x[v] * (is_curved ? 4. * w[v] - 1. : 1.);
  for (unsigned int e = 0; is_curved && e < 6; ++e)
    {
      const auto &[i, j] = StoredMesh::edges[e];
      by_w.col(i) += 4. * w[j] * x[4 + e];
      by_w.col(j) += 4. * w[i] * x[4 + e];
    }
  return by_w.rightCols<3>().colwise() - by_w.col(0);
}

/** By a product of Gauss' rules, collapsed (Duffy): volume, and the area of the
 *  face without the first vertex. */
std::array<double, 2>
sizes(const Tetrahedron &x, const bool is_curved)
{
  const dealii::QGauss<1> line(12);
  double                  volume = 0., area = 0.;
  for (unsigned int a = 0; a < line.size(); ++a)
    for (unsigned int b = 0; b < line.size(); ++b)
      {
        const double r = line.point(a)[0], s = line.point(b)[0];
        const double weight = line.weight(a) * line.weight(b);
        const auto   J =
          jacobian(x, {0., 1. - r, r * (1. - s), r * s}, is_curved);
        area +=
          weight * r * (J.col(1) - J.col(0)).cross(J.col(2) - J.col(0)).norm();
        for (unsigned int c = 0; c < line.size(); ++c)
          {
            const double t = line.point(c)[0];
            volume +=
              weight * line.weight(c) * t * t * r *
              std::abs(
                jacobian(x,
                         {1. - t, t * (1. - r), t * r * (1. - s), t * r * s},
                         is_curved)
                  .determinant());
          }
      }
  return {{volume, area}};
}

struct File
{
  std::vector<Vector3d>         nodes;
  std::vector<std::vector<int>> cells; ///< numbers from 1 on
};

File
file_of(const std::vector<Tetrahedron> &tetrahedra, const unsigned int n)
{
  File file;
  for (const Tetrahedron &t : tetrahedra)
    {
      auto &cell = file.cells.emplace_back();
      for (unsigned int a = 0; a < n; ++a)
        {
          unsigned int k = 0;
          while (k < file.nodes.size() && (file.nodes[k] - t[a]).norm() > 1e-9)
            ++k;
          if (k == file.nodes.size())
            file.nodes.push_back(t[a]);
          cell.push_back(k + 1);
        }
    }
  return file;
}

// S3 of Abaqus is the face without the first vertex; the upper half is held.
void
write_inp(const File &file, const std::string &name)
{
  std::ofstream out(name);
  out.precision(17);
  out << "*Node\n";
  for (unsigned int k = 0; k < file.nodes.size(); ++k)
    out << k + 1 << ", " << file.nodes[k][0] << ", " << file.nodes[k][1] << ", "
        << file.nodes[k][2] << '\n';
  out << "*Element, type=C3D" << file.cells[0].size() << '\n';
  for (unsigned int e = 0; e < file.cells.size(); ++e)
    {
      out << e + 1;
      for (const int node : file.cells[e])
        out << ", " << node;
      out << '\n';
    }
  out << "*Elset, elset=up, generate\n1, 4, 1\n"
      << "*Elset, elset=down, generate\n5, 8, 1\n"
      << "*Surface, name=held\nup, S3\n*Surface, name=contact\ndown, S3\n";
}

// Gmsh has the middles of the edges 0 3, 2 3, 1 3 in this order.
void
write_msh(const File &file, const std::string &name)
{
  std::ofstream out(name);
  out.precision(17);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n"
         "2 1 \"held\"\n2 2 \"contact\"\n$EndPhysicalNames\n$Nodes\n"
      << file.nodes.size() << '\n';
  for (unsigned int k = 0; k < file.nodes.size(); ++k)
    out << k + 1 << ' ' << file.nodes[k].transpose() << '\n';
  out << "$EndNodes\n$Elements\n" << 2 * file.cells.size() << '\n';
  const bool is_curved = file.cells[0].size() == 10;
  for (unsigned int e = 0; e < file.cells.size(); ++e)
    {
      const auto &node = file.cells[e];
      out << 2 * e + 1 << (is_curved ? " 11 2 9 9" : " 4 2 9 9");
      for (const int a : {0, 1, 2, 3, 4, 5, 6, 7, 9, 8})
        if (a < int(node.size()))
          out << ' ' << node[a];
      const int group = e < 4 ? 1 : 2;
      out << '\n'
          << 2 * e + 2 << (is_curved ? " 9" : " 2") << " 2 " << group << ' '
          << group;
      for (const int a : {1, 2, 3, 5, 9, 8})
        if (a < 4 || is_curved)
          out << ' ' << node[a];
      out << '\n';
    }
  out << "$EndElements\n";
}

/** By the functions of the program; a part that is the wrong way round counts
 *  as less than nothing, as in its stiffness. */
double
volume_of(const BulkSpace &space)
{
  const auto rule = dealii::QGauss<3>(3);
  double     sum  = 0.;
  for (const BulkSpace::Cell &cell : space.cells())
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const ShapeValues N = CellFunctions(space, cell).at(rule.point(q));
        Eigen::Matrix3d   J = Eigen::Matrix3d::Zero();
        for (unsigned int a = 0; a < N.rows(); ++a)
          J += space.reference_position(cell.nodes[a]) * N.row(a).tail<3>();
        sum += rule.weight(q) * J.determinant();
      }
  return sum;
}

/** Its sides are so curved that one of the four hexahedra has a negative volume
 *  by its corners, though the map of the tetrahedron is positive. */
void
test_tangled_corners()
{
  const Tetrahedron t{{{0., 0., 0.},
                       {1., 0., 0.},
                       {0., 1., 0.},
                       {0., 0., 1.},
                       {0.471, 0.143, -0.006},
                       {0.178, 0.598, 0.22},
                       {0.228, 0.809, 0.184},
                       {-0.198, -0.227, 0.396},
                       {0.534, -0.28, 0.572},
                       {0.044, 0.851, 0.026}}};
  StoredMesh        stored;
  for (const Vector3d &x : t)
    stored.nodes.emplace_back(x[0], x[1], x[2]);
  stored.tetrahedra = {{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}};
  stored.groups     = {{"held", {{{0, 1, 2, StoredMesh::none}}}},
                       {"contact", {{{1, 2, 3, StoredMesh::none}}}}};
  stored.cut_tetrahedra();
  BodyParameters body;
  body.shape   = BodyShape::file;
  body.element = ElementKind::quadratic;
  body.mesh    = MeshBuilder(stored, [](const std::string &why) {
                throw std::runtime_error(why);
              }).mesh;
  report("volume where corners are tangled",
         std::abs(volume_of(BulkSpace(body, Side::bone)) / sizes(t, true)[0] -
                  1.),
         1e-12);
}

int
main()
{
  for (const bool is_curved : {true, false})
    {
      const auto tetrahedra = ball();
      double     volume = 0., area = 0.;
      for (const Tetrahedron &t : tetrahedra)
        {
          const auto [of_one, of_face] = sizes(t, is_curved);
          volume += of_one;
          area += 0.5 * of_face; // of the lower half
        }
      if (!is_curved)
        {
          report("volume of the octahedron", std::abs(volume - 4. / 3.), 1e-12);
          report("its face", std::abs(area - 2. * std::sqrt(3.)), 1e-12);
        }
      const File file = file_of(tetrahedra, is_curved ? 10 : 4);
      write_inp(file, "ball.inp");
      write_msh(file, "ball.msh");
      const std::string order = is_curved ? "10 nodes" : "4 nodes";
      for (const std::string name : {"ball.inp", "ball.msh"})
        {
          BodyParameters body;
          body.shape   = BodyShape::file;
          body.element = ElementKind::quadratic;
          body.mesh    = read_mesh_file(name, "Bone / Mesh file");
          const BulkSpace space(body, Side::bone);
          const double    sum = volume_of(space);
          report(name + ", " + order + ": volume",
                 std::abs(sum / volume - 1.),
                 1e-12);
          double of_face = 0.;
          for (const auto &point :
               surface_quadrature(space.surface(), dealii::QGauss<1>(9)))
            of_face += point.JxW;
          report("area of contact", std::abs(of_face / area - 1.), 1e-9);
          std::cout << space.cells().size() << " cells, "
                    << space.surface().n_elements() << " faces, "
                    << space.surface().n_pieces() << " pieces\n";
        }
    }
  test_tangled_corners();
}
