"""How Sphinx makes the manual of the pages that scripts/manual_pages.py has laid out. Nothing is loaded from a net."""

project = "Platen"
author = "the authors of Platen"
copyright = "the authors of Platen, LGPL-2.1-or-later"
root_doc = "index"
extensions = ["myst_parser"]
exclude_patterns = ["files/**"]
templates_path = []

myst_heading_anchors = 5  # links to headings, as on the forges
# Indented code is of the shell, of scenes and of formulas alike.
highlight_language = "none"

html_theme = "furo"
html_title = "Platen"
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_last_updated_fmt = None
html_theme_options = {
    "light_css_variables": {"font-stack": "system-ui, 'DejaVu Sans', sans-serif",
                            "font-stack--monospace": "'DejaVu Sans Mono', monospace"},
    "dark_css_variables": {"font-stack": "system-ui, 'DejaVu Sans', sans-serif",
                           "font-stack--monospace": "'DejaVu Sans Mono', monospace"},
}
html_static_path = ["_static"]
html_css_files = ["manual.css"]
