#!/usr/bin/env python3
"""Makes one typeface of the console out of one of Debian's. The same input gives the same bytes.

usage: make_face.py sans FROM TO   LiENa Sans: Inter, whose figures all take the same room and whose zero is slashed
       make_face.py hei FROM TO    LiENa Hei: the Chinese of WenQuanYi Micro Hei

Each has a name of its own, so that no face of the system is ever taken for it. The notes on copyright, trademark and licence stay.
"""
import sys

from fontTools import subset

WINDOWS_ENGLISH = (3, 1, 0x409)
FAMILY, UNIQUE, FULL, POSTSCRIPT, DESCRIPTION, TYPOGRAPHIC_FAMILY = 1, 3, 4, 6, 10, 16
KEPT_NAMES = [*range(15), 16, 17]  # without those of stylistic sets, which go

FIGURES = [ord(figure) for figure in "0123456789"]
PRIVATE_USE = range(0xE000, 0xF900)
# Every ideograph, since names of people need rare ones; their punctuation, phonetic letters and full-width forms. No ASCII: those letters
# and figures are LiENa Sans's.
CHINESE = [range(0x2E80, 0x3130), range(0x3400, 0xA000), range(0xF900, 0xFB00), range(0xFE30, 0xFE50), range(0xFF00, 0xFFF0)]


def single_substitutions(font, feature):
    """What `feature` puts for which glyph."""
    table = font["GSUB"].table
    lookups = {index for record in table.FeatureList.FeatureRecord if record.FeatureTag == feature for index in record.Feature.LookupListIndex}
    glyphs = {}
    for index in sorted(lookups):
        for part in table.LookupList.Lookup[index].SubTable:
            glyphs.update(getattr(part, "ExtSubTable", part).mapping)
    return glyphs


def give_one_width(font, glyphs):
    """As wide as the widest. Inter's bold four misses it by almost a five-hundredth of an em; more would be no tabular figures."""
    metrics, widths = font["hmtx"], [font["hmtx"][glyph][0] for glyph in glyphs]
    if max(widths) - min(widths) > font["head"].unitsPerEm / 500:
        sys.exit("make_face.py: this is no Inter: the figures of its feature tnum are not of one width")
    for glyph in glyphs:
        metrics[glyph] = (max(widths), metrics[glyph][1])


def freeze_figures(font):
    """Leads the ten figures to their tabular glyphs, and zero to the slashed one of those: Qt 6.4 cannot ask for the features.

    Punctuation stays as it is: its tabular forms are hardly other in width, and the rules that lift a colon between figures do not know them.
    """
    tabular, slashed = single_substitutions(font, "tnum"), single_substitutions(font, "zero")
    usual = font.getBestCmap()
    glyphs = {figure: tabular.get(usual[figure]) for figure in FIGURES}
    glyphs[ord("0")] = slashed.get(glyphs[ord("0")])
    if None in glyphs.values():
        sys.exit("make_face.py: this is no Inter: its features tnum and zero do not give ten figures, and a slashed zero among them")
    give_one_width(font, glyphs.values())
    for table in font["cmap"].tables:
        if table.isUnicode():
            table.cmap.update(glyphs)


def rename(font, old, new, description):
    for record in font["name"].names:
        if record.nameID in (FAMILY, FULL, POSTSCRIPT, TYPOGRAPHIC_FAMILY):
            name = str(record).replace(old, new).replace(old.replace(" ", ""), new.replace(" ", ""))
            record.string = name.replace(" ", "") if record.nameID == POSTSCRIPT else name
    names = font["name"]
    postscript = names.getDebugName(POSTSCRIPT)
    names.setName(postscript + ", made of " + names.getDebugName(UNIQUE), UNIQUE, *WINDOWS_ENGLISH)
    names.setName(description, DESCRIPTION, *WINDOWS_ENGLISH)
    if "CFF " in font:
        font["CFF "].cff.fontNames[0] = postscript
        top = font["CFF "].cff.topDictIndex[0]
        top.FullName, top.FamilyName = names.getDebugName(FULL), new


def reduce_to(font, characters, options):
    """Leaves only what `characters` need. Ascent, descent and line gap stay, and so does the box for what is missing."""
    options.name_IDs = KEPT_NAMES
    options.notdef_outline = True
    options.drop_tables += ["FFTM", "vhea", "vmtx"]
    subsetter = subset.Subsetter(options)
    subsetter.populate(unicodes=characters)
    subsetter.subset(font)


def make_sans(font, options):
    freeze_figures(font)
    reduce_to(font, [code for code in font.getBestCmap() if code not in PRIVATE_USE], options)
    rename(font, "Inter", "LiENa Sans", "Inter, whose figures are its tabular ones and whose zero is its slashed one. Changed by the LiENa project.")


def make_hei(font, options):
    options.hinting = False  # as Debian's settings ask for it
    reduce_to(font, [code for code in font.getBestCmap() if any(code in part for part in CHINESE)], options)
    rename(font, "WenQuanYi Micro Hei", "LiENa Hei", "The Chinese of WenQuanYi Micro Hei. Changed by the LiENa project.")


def main(arguments):
    makers = {"sans": make_sans, "hei": make_hei}
    if len(arguments) != 3 or arguments[0] not in makers:
        sys.exit(__doc__)
    what, source, target = arguments
    options = subset.Options()
    options.font_number = 0  # of a collection; the times in the file stay, too
    font = subset.load_font(source, options, dontLoadGlyphNames=False)
    makers[what](font, options)
    subset.save_font(font, target, options)


if __name__ == "__main__":
    main(sys.argv[1:])
