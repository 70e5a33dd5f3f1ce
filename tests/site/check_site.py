#!/usr/bin/env python3
"""check_site.py DIR: checks the site in DIR, which must be complete without a network.

Relative links lead to files, and their #anchors to ids there; scripts, style sheets, pictures and fonts are files of the
site; the index of the search is there, and has the titles of the pages. Prints what is wrong; exit code 1.
check_site.py --test makes small sites with one error each and checks that it is found.
"""

import html.parser
import os
import re
import sys
import tempfile
import urllib.parse

# attributes by which a page loads something, rather than leads somewhere
LOADED = {("script", "src"), ("img", "src"), ("img", "srcset"), ("source", "src"), ("source", "srcset"), ("video", "src"),
          ("video", "poster"), ("audio", "src"), ("iframe", "src"), ("embed", "src"), ("object", "data"), ("input", "src"),
          ("link", "href")}
# links of the head that load nothing
LEADING = {"canonical", "index", "search", "next", "prev", "author", "copyright", "top", "up", "alternate"}


class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.ids, self.links, self.loaded, self.texts, self.title = set(), [], [], [], ""
        self.inside = None

    def handle_starttag(self, tag, attributes):
        attributes = {name: value or "" for name, value in attributes}
        self.inside = tag if tag in ("style", "script", "title") else None
        for name in ("id", "name"):
            if name in attributes and (name == "id" or tag == "a"):
                self.ids.add(attributes[name])
        rel = set(attributes.get("rel", "").split())
        for name, value in attributes.items():
            if name == "style":
                self.texts.append(value)
            elif (tag, name) in LOADED and not (tag == "link" and rel and rel <= LEADING):
                urls = [part.split()[0] for part in value.split(",") if part.split()] if name == "srcset" else [value]
                self.loaded += urls
            elif name == "href":
                self.links.append(value)

    def handle_endtag(self, tag):
        self.inside = None

    def handle_data(self, data):
        if self.inside == "style":
            self.texts.append(data)
        elif self.inside == "title":
            self.title += data


def loaded_by(style):
    """What a style sheet loads: url(...) and @import "..."."""
    style = re.sub(r"/\*.*?\*/", "", style, flags=re.S)
    return [match[0] or match[1] for match in re.findall(r"url\(\s*[\"']?([^\"')]+)|@import\s+[\"']([^\"']+)", style)]


def is_elsewhere(url):
    parts = urllib.parse.urlsplit(url.strip())
    return bool(parts.netloc) or parts.scheme not in ("", "data") or parts.path.startswith("/")


def check(directory):
    """-> what is wrong, and how many pages and links were looked at"""
    pages, wrong, n_links = {}, [], 0
    for folder, folders, names in os.walk(directory):
        if os.path.join("developers", "api") in folder:  # Doxygen's, which checks them
            folders.clear()
            continue
        for name in names:
            path = os.path.join(folder, name)
            if name.endswith(".html"):
                pages[path] = Page()
                with open(path, encoding="utf-8") as text:
                    pages[path].feed(text.read())
            elif name.endswith(".css"):
                with open(path, encoding="utf-8") as text:
                    for url in loaded_by(text.read()):
                        file = os.path.join(folder, urllib.parse.urlsplit(url).path)
                        if is_elsewhere(url) or not url.startswith("data:") and not os.path.exists(file):
                            wrong.append(f"{path}: loads {url}")

    for path, page in pages.items():
        for url in page.loaded + [url for text in page.texts for url in loaded_by(text)]:
            file = os.path.join(os.path.dirname(path), urllib.parse.unquote(urllib.parse.urlsplit(url).path))
            if is_elsewhere(url) or not url.startswith("data:") and not os.path.isfile(file):
                wrong.append(f"{path}: loads {url}")
        for url in page.links:
            parts = urllib.parse.urlsplit(url)
            if parts.scheme or parts.netloc:
                continue  # for who has a network
            n_links += 1
            file = os.path.normpath(os.path.join(os.path.dirname(path), urllib.parse.unquote(parts.path))) if parts.path else path
            if not os.path.isfile(file):
                wrong.append(f"{path}: leads to {url}, which is not there")
            elif parts.fragment and file in pages and urllib.parse.unquote(parts.fragment) not in pages[file].ids:
                wrong.append(f"{path}: leads to {url}, which has no such anchor")

    index = os.path.join(directory, "searchindex.js")
    if not os.path.exists(index):
        wrong.append(f"{index}: is missing")
    else:
        with open(index, encoding="utf-8") as text:
            found = text.read()
        for path, page in pages.items():
            name = os.path.relpath(path, directory)[:-len(".html")]
            if name not in ("search", "genindex") and f'"{name}"' not in found:
                wrong.append(f"{index}: does not have {name}")
    if os.path.join(directory, "index.html") not in pages:
        wrong.append(f"{directory}: has no index.html")
    return wrong, len(pages), n_links


def test():
    good = {"index.html": '<title>a</title><link rel="stylesheet" href="a.css"><link rel="next" href="b.html">'
                          '<a href="b.html#x">b</a><a href="https://doi.org/1">c</a><img src="p%20q.png">',
            "b.html": '<h1 id="x"></h1><a href="#x">x</a>', "a.css": "/* url(https://x.org) */ a{background:url('p q.png')}",
            "p q.png": "", "searchindex.js": '{docnames:["index","b"]}'}
    bad = {
        "none": {},
        "which is not there": {"b.html": '<h1 id="x"></h1><a href="c.html">x</a>'},
        "which has no such anchor": {"b.html": '<h1 id="x"></h1><a href="#y">x</a>'},
        "loads /q.css": {"a.css": '@import url(/q.css)'},
        "loads https://x.org/a.js": {"b.html": '<h1 id="x"></h1><script src="https://x.org/a.js"></script>'},
        "loads //x.org/a.css": {"b.html": '<h1 id="x"></h1><link rel="stylesheet" href="//x.org/a.css">'},
        "loads https://x.org/f.woff": {"a.css": '@font-face{src:url("https://x.org/f.woff")}'},
        "loads https://x.org/i.css": {"b.html": '<h1 id="x"></h1><style>@import "https://x.org/i.css"</style>'},
        "loads q.png": {"b.html": '<h1 id="x"></h1><img src="q.png">'},
        "does not have b": {"searchindex.js": '{docnames:["index"]}'},
        "is missing": {"searchindex.js": None},
    }
    for expected, changed in bad.items():
        with tempfile.TemporaryDirectory() as directory:
            for name, text in {**good, **changed}.items():
                if text is not None:
                    with open(os.path.join(directory, name), "w", encoding="utf-8") as file:
                        file.write(text)
            wrong, _, _ = check(directory)
            if len(wrong) != (expected != "none") or wrong and expected not in wrong[0]:
                sys.exit(f"expected {expected}, found {wrong}")


if __name__ == "__main__":
    if sys.argv[1:] == ["--test"]:
        test()
        sys.exit()
    wrong, n_pages, n_links = check(os.path.normpath(sys.argv[1]))
    print("\n".join(wrong) if wrong else f"{n_pages} pages, {n_links} links")
    sys.exit(bool(wrong))
