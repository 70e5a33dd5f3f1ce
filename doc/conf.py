"""The site: cmake --build build/release --target site. Made by Sphinx with MyST from the Markdown of this directory.

What a page needs is in the site, so that it can be read from its files, without a network. Environment: DEBOND_VERSION,
and DEBOND_API, the directory of the pages of the source (target documentation), which are copied if they are there, and
linked from the pages for developers.
"""

import glob
import html
import os
import re
import shutil

from docutils import nodes

project = "debond"
author = "The authors of debond"
project_copyright = "2026, " + author
version = release = os.environ.get("DEBOND_VERSION", "")

extensions = ["myst_parser", "sphinx.ext.mathjax"]
source_suffix = {".md": "markdown"}
root_doc = "index"
# scripts and data; pages of a site stand in its sections
exclude_patterns = ["_static", "_templates", "example", "images", "paper", "paraview", "slurm", "studies", "verification", "stability"]
nitpicky = True  # links that lead nowhere are warnings, which are errors

myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 4
myst_dmath_double_inline = True
myst_update_mathjax = False  # its settings are those of MathJax 3

html_theme = "furo"
html_title = f"{project} {version}".strip()
html_static_path = ["_static"]
html_css_files = ["site.css"]
templates_path = ["_templates"]
html_copy_source = False
html_show_sphinx = False
html_show_search_summary = False  # browsers do not read other pages from files
html_theme_options = {"navigation_with_keys": False}
html_sidebars = {"**": ["sidebar/scroll-start.html", "sidebar/brand.html", "sidebar/search.html", "sidebar/navigation.html",
                        "sidebar/source.html", "sidebar/scroll-end.html"]}
pygments_style = "friendly"
highlight_language = "none"

# MathJax 2 of Debian: scripts are read with <script>, formulas drawn as SVG, so that no font has to be fetched.
MATHJAX = os.environ.get("DEBOND_MATHJAX", "/usr/share/javascript/mathjax")
MATHJAX_PARTS = ["MathJax.js", "extensions/tex2jax.js", "extensions/MathEvents.js", "extensions/TeX", "jax/element/mml",
                 "jax/input/TeX", "jax/output/SVG/autoload", "jax/output/SVG/config.js", "jax/output/SVG/jax.js",
                 "jax/output/SVG/fonts/TeX"]
mathjax_path = "mathjax/MathJax.js"
mathjax2_config = {
    "jax": ["input/TeX", "output/SVG"],
    "extensions": ["tex2jax.js"],
    "TeX": {"extensions": ["AMSmath.js", "AMSsymbols.js", "noErrors.js", "noUndefined.js"]},
    "tex2jax": {"inlineMath": [["\\(", "\\)"]], "displayMath": [["\\[", "\\]"]], "ignoreClass": "document", "processClass": "math"},
    "SVG": {"font": "TeX", "scale": 92, "linebreaks": {"automatic": True, "width": "container"}},
    "showMathMenu": False,
    "messageStyle": "none",
}

API = os.environ.get("DEBOND_API", "")
html_context = {"api": bool(API) and os.path.exists(os.path.join(API, "index.html"))}


def github_anchor(title):
    return re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-")


def add_github_anchors(app, doctree):
    """Headings have the anchors that they have on GitHub, too."""
    sections = list(doctree.findall(nodes.section))
    found = {}
    for section in sections:
        anchor = github_anchor(section[0].astext())
        number = found.get(anchor, 0)
        found[anchor] = number + 1
        if number:
            anchor = f"{anchor}-{number}"
        if anchor and not any(anchor in other["ids"] for other in sections):
            section["ids"].append(anchor)


def keep_environments(app, doctree):
    """Sphinx would put formulas of several lines into an environment in which \\tag is an error."""
    for block in doctree.findall(nodes.math_block):
        if not block.get("nowrap") and re.search(r"\\begin\b|\\tag\b", block.astext()):
            block.children = [nodes.Text(f"\\[{block.astext()}\\]")]
            block["nowrap"] = True


def source_page(name):
    """The page of a source file, as Doxygen calls it, below developers; nothing if there is none."""
    if name == "developers/api/index.html":
        return "api/index.html"
    file = os.path.basename(name).replace("_", "__").replace(".", "_8") + "_source.html"
    return f"api/{file}" if os.path.exists(os.path.join(API, file)) else ""


def link_sources(app, doctree, page):
    """In the pages for developers, names of source files lead to the pages of the source, if these were made."""
    if not html_context["api"] or app.builder.format != "html" or not page.startswith("developers/"):
        return
    for name in list(doctree.findall(nodes.literal)):
        if re.fullmatch(r"[\w/]+\.(h|cc|html)", name.astext()) and not isinstance(name.parent, nodes.reference):
            to = source_page(name.astext())
            if to:
                name.replace_self(nodes.reference("", "", name.deepcopy(), refuri=to, internal=True))


def break_code(app, doctree, page):
    """In tables, names may go on in the next line behind a part: columns are less wide."""
    if app.builder.format != "html":
        return
    for entry in doctree.findall(nodes.entry):
        for code in list(entry.findall(nodes.literal)):
            words = [re.sub(r"(/|_|::|(?<=[a-z])(?=[A-Z]))(?=\w)", "\\1\0", word) for word in code.astext().split(" ")]
            text = " ".join(f'<span class="pre">{html.escape(word)}</span>' for word in words)
            text = text.replace("\0", '</span><wbr><span class="pre">')
            code.replace_self(nodes.raw("", f'<code class="docutils literal notranslate">{text}</code>', format="html"))


def copy_parts(app, exception):
    if exception or app.builder.format != "html":
        return
    if not os.path.exists(os.path.join(MATHJAX, "MathJax.js")):
        raise RuntimeError(f"no MathJax 2 in {MATHJAX}: apt install libjs-mathjax")
    to = os.path.join(app.outdir, "_static", "mathjax")
    for part in MATHJAX_PARTS:
        source, target = os.path.join(MATHJAX, part), os.path.join(to, part)
        if os.path.isdir(source):
            shutil.copytree(source, target, dirs_exist_ok=True)
        else:
            os.makedirs(os.path.dirname(target), exist_ok=True)
            shutil.copy(source, target)
    # Style sheets of Debian's themes name files that a server of Debian has.
    styles = glob.glob(os.path.join(app.outdir, "_static", "**", "*.css"), recursive=True)
    for path in filter(os.path.isfile, styles):
        with open(path, encoding="utf-8") as file:
            style = file.read()
        for name in set(re.findall(r"(?<![.\w])/javascript/([\w./-]+)", style)):
            target = os.path.join(app.outdir, "_static", "javascript", name)
            os.makedirs(os.path.dirname(target), exist_ok=True)
            shutil.copy(os.path.join("/usr/share/javascript", name), target)
            style = style.replace("/javascript/" + name, os.path.relpath(target, os.path.dirname(path)))
            with open(path, "w", encoding="utf-8") as file:
                file.write(style)
    if html_context["api"]:
        api = os.path.join(app.outdir, "developers", "api")
        shutil.copytree(API, api, dirs_exist_ok=True)
        paths = glob.glob(os.path.join(api, "**", "*.html"), recursive=True) + [os.path.join(api, "menudata.js")]
        for path in filter(os.path.exists, paths):
            with open(path, encoding="utf-8") as file:
                page = file.read()
            page = page.replace(f'src="{MATHJAX}/', f'src="{os.path.relpath(to, os.path.dirname(path))}/')
            page = page.replace('"../site/', '"../../')  # they were made beside the site
            with open(path, "w", encoding="utf-8") as file:
                file.write(page)


def setup(app):
    app.connect("doctree-read", add_github_anchors)
    app.connect("doctree-read", keep_environments)
    app.connect("doctree-resolved", link_sources)
    app.connect("doctree-resolved", break_code)
    app.connect("build-finished", copy_parts)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
