#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  class EntryTable;
  struct SceneEntry;

  /** A law that scenes can choose, with its parameters. A copy has a law of its
   *  own, as copies of a scene have. */
  template <class Law>
  struct LawPlugin
  {
    /** @p name: its choice of the entry, @p description: what that means. */
    template <class OneLaw>
    LawPlugin(const std::string &name,
              const std::string &description,
              const OneLaw      &law)
      : name(name)
      , description(description)
      , law([own = law]() mutable -> Law & { return own; })
    {}

    std::string            name, description;
    std::function<Law &()> law; ///< holds it, and copies it with itself
  };



  /** Laws of a kind, as each stands in its own source, in the order of their
   *  choices. */
  template <class Law>
  std::vector<LawPlugin<Law>>
  all_laws();



  /** The choice of a law in `Interface`, and the parameters of all of its kind.
   */
  template <class Law>
  class LawChoice
  {
  public:
    /** @p entry that chooses. */
    LawChoice(const std::string &entry, const std::string &default_law)
      : entry(entry)
      , law(default_law)
    {}

    /** Rows of the choice, @p about something, and of the parameters. */
    void
    declare(EntryTable &table, const std::string &about);

    /** A law as chosen, not initialised. */
    std::shared_ptr<Law>
    make() const;

    /** Names of the laws that have an entry. */
    std::vector<std::string>
    laws_with(const std::string &full_name) const;

  private:
    std::string entry;

  public:
    // Plug-ins are copied with the choice: parameters of all laws are part of a
    // scene, so that scenes can be values.
    std::string                 law; ///< the name of what is chosen
    std::vector<LawPlugin<Law>> laws = all_laws<Law>();
  };
} // namespace Debond
