#pragma once

#include <debond/input/allowed_values.h>
#include <debond/scene/scene.h>

#include <optional>
#include <vector>

namespace Debond
{
  /** Cells half as many again, and two thirds: the opposite, for what it has
   *  made. */
  unsigned int
  more_cells(unsigned int n);
  unsigned int
  fewer_cells(unsigned int n);

  /** Whether all deformable bodies from files have a Coarser mesh file. */
  bool
  has_coarser_files(const Scene &scene);

  /** The scene with two thirds of the cells in every direction, or with half as
   *  many again where some cannot be fewer, and half the planned steps: what
   * its error is estimated by. Files are the coarser ones, or trilinear. Its
   *  results are in the folder `coarser` of the scene's. None if nothing of its
   *  meshes can be changed. */
  std::optional<Scene>
  coarser_scene(const Scene &scene);

  /** The scene with half as many of the cells again that were chosen for it;
   *  none if it sets all itself. */
  std::optional<Scene>
  finer_scene(const Scene &scene);

  /** The scene with Neo-Hookean bodies in the place of linear ones that were
   *  chosen for it; none if there are none. */
  std::optional<Scene>
  with_large_strains(const Scene &scene);

  /** "fitted 8, 3, 5, 5 and fitted 8, 3, 3", of bone and implant. */
  std::string
  cells_in_words(const Scene &scene);

  /** The entries of completed parameters, those that were chosen `auto'. */
  std::vector<SceneEntry>
  open_choices(const std::string &parameters);

  /** The scene with cells, elements and materials that were chosen for it in
   *  completed parameters. */
  Scene
  with_choices_of(const Scene &scene, const std::string &parameters);

  /** The entries that were chosen, as the text of completed parameters names
   *  them. */
  std::vector<std::string>
  choices_in(const std::string &parameters);

  /** Whether two completed parameters are of the same scene: those that were
   *  chosen may differ. */
  bool
  is_same_scene(const std::string &parameters, const std::string &earlier);
} // namespace Debond
