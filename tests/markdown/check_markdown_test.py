"""What scripts/check_markdown.py tells and what it leaves alone, on pages made for it."""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import check_markdown  # noqa: E402

OTHER = "# Other page\n\n## A heading, with signs (2)\n\n## Twice\n\n## Twice\n"


def told(text):
    """Faults of a page beside other.md and picture.png."""
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "page.md"
        page.write_text(text, encoding="utf-8")
        (page.parent / "other.md").write_text(OTHER, encoding="utf-8")
        (page.parent / "picture.png").write_bytes(b"")
        return [(line, words) for line, words in check_markdown.check(page.resolve(), {})]


class Links(unittest.TestCase):
    def test_living_ones_are_left_alone(self):
        self.assertEqual(told("# A\n[a](other.md) [b](other.md#a-heading-with-signs-2) [c](#a) [d](other.md#twice-1)\n"
                              "![e](picture.png) [![f](picture.png)](other.md) [g](https://x.example/y)\n"), [])

    def test_a_missing_file_is_told_with_its_line(self):
        self.assertEqual(told("# A\n\nand [a](gone.md) here\n"), [(3, "gone.md: there is no gone.md")])

    def test_a_missing_picture_is_told(self):
        self.assertEqual(len(told("![a](gone.png)\n")), 1)
        self.assertEqual(len(told('<img alt="a" src="gone.svg">\n')), 1)
        self.assertEqual(len(told("[![a](gone.png)](other.md)\n")), 1)

    def test_a_missing_heading_is_told(self):
        self.assertEqual(len(told("[a](other.md#gone)\n")), 1)
        self.assertEqual(len(told("[a](#gone)\n")), 1)

    def test_a_link_over_a_line_end_is_read(self):
        self.assertEqual([line for line, _ in told("# A\n\n[a\nb](gone.md)\n")], [3])

    def test_code_is_left_alone(self):
        self.assertEqual(told("`[a](gone.md)`\n\n    [b](gone.md)\n\n```\n[c](gone.md)\n| a |\n```\n"), [])

    def test_a_link_whose_words_are_code_is_read(self):
        self.assertEqual(len(told("[`a`](gone.md)\n")), 1)


class Tables(unittest.TestCase):
    HEAD = "| a | b |\n| --- | --- |\n"

    def test_a_whole_one_is_left_alone(self):
        self.assertEqual(told(self.HEAD + "| `x\\|y` | 2 |\n| 3 | 4 |\n"), [])

    def test_a_row_with_other_columns_is_told(self):
        self.assertEqual(told(self.HEAD + "| 1 | 2 | 3 |\n"), [(3, "3 columns in a table of 2")])
        self.assertEqual(told(self.HEAD + "| 1 |\n"), [(3, "1 columns in a table of 2")])

    def test_a_bar_in_code_is_a_border(self):
        self.assertEqual(len(told(self.HEAD + "| `x|y` | 2 |\n")), 1)

    def test_a_doubled_row_is_told(self):
        self.assertEqual(len(told(self.HEAD + "| 1 | 2 |\n| 3 | 4 |\n| 1 | 2 |\n")), 1)

    def test_a_key_with_two_meanings_is_told(self):
        self.assertEqual(len(told(self.HEAD + "| `x` | 2 |\n| `x` | 3 |\n")), 1)

    def test_groups_of_a_table_may_say_the_same(self):
        self.assertEqual(told(self.HEAD + "| x | 2 |\n| x | 2 |\n| x | 3 |\n"), [])

    def test_a_table_that_is_cut_in_two_is_told(self):
        self.assertEqual([line for line, _ in told(self.HEAD + "| 1 | 2 |\n\n| 3 | 4 |\n")], [5])


class Run(unittest.TestCase):
    def status(self, text):
        with tempfile.TemporaryDirectory() as folder:
            if text is not None:
                pathlib.Path(folder, "a.md").write_text(text, encoding="utf-8")
            old, sys.argv = sys.argv, ["check_markdown.py", "--root", folder]
            try:
                with contextlib.redirect_stdout(io.StringIO()):
                    return check_markdown.main()
            finally:
                sys.argv = old

    def test_status_tells_faults(self):
        self.assertEqual(self.status("# A\n"), 0)
        self.assertEqual(self.status("[a](gone.md)\n"), 1)

    def test_no_page_at_all_is_a_fault(self):
        self.assertEqual(self.status(None), 1)


if __name__ == "__main__":
    unittest.main()
