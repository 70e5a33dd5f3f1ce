#!/bin/bash
# browser.sh DEBOND CHROMIUM: a page of a run in a browser as narrow as a telephone. A script that only this test adds looks
# whether all pictures are there, and whether the page has to be moved sideways.
set -eu
debond=$1 chromium=$2
"$debond" "$(dirname "$0")/scene.prm"
{
  cat run/report.html
  echo '<p id="seen"></p><script>
    window.addEventListener("load", () => {
    const images = Array.from(document.images);
    document.getElementById("seen").textContent = images.length + " pictures, " +
      images.filter(i => !i.complete || i.naturalWidth == 0).length + " broken, wider than the window: " +
      (document.documentElement.scrollWidth > window.innerWidth);
    });
  </script>'
} > looked-at.html
"$chromium" --headless --no-sandbox --disable-gpu --window-size=500,900 --virtual-time-budget=5000 --dump-dom \
  "file://$PWD/looked-at.html" 2> /dev/null | grep -o '[0-9]* pictures, [0-9]* broken, wider than the window: [a-z]*'
