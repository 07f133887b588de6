r"""How programs write tables: one description each, which `heads` goes by.

Patterns are regular expressions. They are matched at the beginning of a line, of which quotes and
blanks around the cells are left out, but for those that state one fact, which are sought anywhere
in the head.

A head is made of lines, of which one names the columns. Where that line has only axes, the names of
markers or bodies stand in another one. Rows of numbers follow the head. For instance Vicon Nexus::

    Trajectories
    100
    ,,Ann:LKNE,,,Ann:RKNE,,
    Frame,Sub Frame,X,Y,Z,X,Y,Z
    ,,mm,mm,mm,mm,mm,mm
    1,0,12.5,…
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["DIALECTS", "PLAIN", "Dialect", "Place"]

Place = tuple[str, int]
"""A line of the head: the pattern of one, and by how many lines it lies below that."""

_NONE = r"(?!)()"
"""What no line matches."""
_S = r"[,;\t]"
"""What separates cells; a table is still known after a spreadsheet saved it with other ones."""
_DECIMAL = r"(\d+(?:[.,]\d+)?)"


@dataclass(frozen=True)
class Dialect:
    """How a program writes a table.

    Parameters
    ----------
    program : str
        What messages call the table.
    sign : str
        With what the text begins, over several lines if need be.
    ends : str
        The last line that every head has.
    ends_with : str
        An example of it, for messages.
    further : str
        Lines below that still belong to the head.
    columns : str
        The line that names the columns.
    names, kinds, groups, units : (str, int)
        The lines with the names of markers or bodies; with "Position" or "Rotation"; with what
        comes before names, such as an animal; with units.
    listed : str
        The line that lists the names of markers, if columns are called by name and axis; each
        stands for X, Y and Z where no line names the columns.
    sorts : tuple of (str, str)
        Whether columns that a single line names are ``"length"`` or ``"angle"``, by patterns of
        whole names; the first that fits counts.
    rate, rows, parts : str
        Facts, each the first group of a pattern: frames per second, the number of rows, and of what
        kind the values are that have several parts with commas between them.
    length, angle : str
        Units.
    length_by, angle_by : str
        Facts that say the units, in place of these.
    blocks : tuple of str
        Titles of the blocks of which the first one that the file has is read; a blank line ends it.
    zeros : bool
        Whether a marker or body at exactly 0, 0, 0 is one that is missing.
    suffixes : tuple of str
        Of files that no other program writes.
    no_motion : str
        What such a table has if it has no motion, and what to export in its place.
    """

    program: str
    sign: str
    ends: str = _NONE
    ends_with: str = ""
    columns: str = _NONE
    further: str = _NONE
    names: Place = (_NONE, 0)
    kinds: Place = (_NONE, 0)
    groups: Place = (_NONE, 0)
    units: Place = (_NONE, 0)
    listed: str = _NONE
    sorts: tuple[tuple[str, str], ...] = ()
    rate: str = _NONE
    rows: str = _NONE
    parts: str = _NONE
    length: str = ""
    angle: str = "deg"
    length_by: str = _NONE
    angle_by: str = _NONE
    blocks: tuple[str, ...] = ()
    zeros: bool = False
    suffixes: tuple[str, ...] = ()
    no_motion: str = ""


_MOTIVE = Dialect(
    program="OptiTrack Motive",
    sign=rf"Format Version{_S}",
    ends=rf"Frame{_S}",
    ends_with="Frame,Time (Seconds),X,Y,Z",
    columns=rf"Frame{_S}",
    # Types stand alone, or behind the word: ",,Marker" up to version 1.23, ",Type,Marker" later.
    # They are words such as Rigid Body, Bone Marker, Trained Markerset.
    names=(rf"(Type)?{_S}(Type)?{_S}+[A-Z]", 1),
    kinds=(rf"Frame{_S}", -1),
    rate=rf"(?:Export Frame Rate|Capture Frame Rate(?!.*Export Frame Rate)){_S}{_DECIMAL}",
    rows=rf"Total Exported Frames{_S}(\d+)",
    length_by=rf"Length Units{_S}(\w+)",
)

_AXES_OF_NEXUS = rf"(?:Frame|Field #?){_S}"
_NEXUS = Dialect(
    program="Vicon Nexus",
    sign=r"(?i:Trajectories|Model Outputs|Joints|Segments|Devices|Events)[,;\t]*\n",
    ends=_AXES_OF_NEXUS,
    ends_with="Frame,Sub Frame,X,Y,Z",
    further=r"[,;\t]*[A-Za-zµ°%]",
    columns=_AXES_OF_NEXUS,
    names=(_AXES_OF_NEXUS, -1),
    units=(_AXES_OF_NEXUS, 1),
    rate=rf"\A[^\n]*\n{_DECIMAL}",
    length="mm",
    blocks=("Trajectories", "Joints", "Model Outputs", "Segments"),
    zeros=True,
)

_QTM_PROGRAM = "Qualisys Track Manager"
_OTHERS_OF_QTM = Dialect(
    program=_QTM_PROGRAM,
    sign=rf"(?:[A-Z_]+{_S}[^\n]*\n){{0,9}}?"
    rf"(?:NO_OF_SAMPLES{_S}|TOT_NO_OF_CHAN{_S}|FORCE_PLATE_|DATA_INCLUDED{_S}2D)",
    no_motion="analogue samples, forces or 2D data: export 3D or 6D data as TSV, or C3D",
)
_AXES_OF_QTM = (
    rf"Frame{_S}|Time{_S}|[^,;\t]*[^,;\t\s] X{_S}"  # the name before the first axis
    rf"|[^,;\t]+{_S}X{_S}Y{_S}"  # or in a column of its own
)
_QTM = Dialect(
    program=_QTM_PROGRAM,
    sign=rf"(?:FILE_VERSION{_S}[^\n]*\n)?NO_OF_\w+{_S}",
    ends=rf"(?:MARKER|BODY|SEGMENT)_NAMES{_S}|{_AXES_OF_QTM}",
    ends_with="MARKER_NAMES or BODY_NAMES",
    further=rf"[A-Z][A-Z_]{{3,}}(?:{_S}|\s*$)|{_AXES_OF_QTM}",
    columns=_AXES_OF_QTM,
    listed=rf"(?:MARKER|BODY|SEGMENT)_NAMES{_S}",
    rate=rf"(?m)^FREQUENCY{_S}{_DECIMAL}",
    rows=rf"(?m)^NO_OF_FRAMES{_S}(\d+)",
    length="mm",
    zeros=True,
)

_DEEPLABCUT = Dialect(
    program="DeepLabCut",
    sign=rf"scorer{_S}",
    ends=rf"coords{_S}",
    ends_with="coords,x,y,likelihood",
    columns=rf"coords{_S}",
    names=(rf"bodyparts{_S}", 0),
    groups=(rf"individuals{_S}", 0),
    length="px",
)

_ENDHEADER = r"\s*endheader\b"
_OF_OPENSIM = r"\s*[A-Za-z_/]"
_TRANSLATION = (r"(?:(?:.*[_/])?t[xyz]|.*trans_?[xyzXYZ])(?:/value)?", "length")
_COORDINATES = Dialect(
    program="OpenSim",
    sign=r"\s*Coordinates\b",
    ends=_ENDHEADER,
    ends_with="endheader",
    further=_OF_OPENSIM,
    columns=r"\s*(?i:time)\b",
    sorts=(_TRANSLATION, (r".*/(?:speed|acceleration|activation)", ""), (r".+", "angle")),
    rate=rf"DataRate\s*=\s*{_DECIMAL}",
    rows=r"n[Rr]ows\s*=\s*(\d+)",
    parts=r"DataType\s*=\s*(\w+)",
    length="m",
    angle="",
    angle_by=r"inDegrees\s*=\s*(\w+)",
)
_STORAGE = Dialect(
    program="OpenSim",
    sign=r"(?:[^\n]*\n){0,50}?\s*(?:endheader|DataRate\s*=|inDegrees\s*=|nColumns\s*=)",
    ends=_ENDHEADER,
    ends_with="endheader",
    further=_OF_OPENSIM,
    columns=r"\s*(?i:time)\b",
    # What else such files have, forces and speeds for instance, they do not say.
    sorts=(_TRANSLATION, (r".*/value", "angle")),
    rate=rf"DataRate\s*=\s*{_DECIMAL}",
    rows=r"(?:n[Rr]ows\s*=|datarows)\s*(\d+)",
    parts=r"DataType\s*=\s*(\w+)",
    length="m",
    angle="",
    angle_by=r"inDegrees\s*=\s*(\w+)",
    suffixes=(".mot", ".sto"),
)

_NAMES_OF_ISEN = rf"(?:Tiempo|Time|Temps|Zeit){_S}[^\n]*::Y(?:{_S}|\n)"
_ISEN = Dialect(
    program="iSen",
    sign=_NAMES_OF_ISEN,
    ends=_NAMES_OF_ISEN.replace(r"\n)", "|$)"),
    ends_with="Tiempo,Hip::Y",
    columns=_NAMES_OF_ISEN.replace(r"\n)", "|$)"),
    # It does not say the units; several graphs may show the same angle.
    sorts=((r".+", ""),),
)

_AXES_BELOW = rf"(?:[^\n,;\t]*{_S}){{1,3}}[Xx]{_S}[Yy]\b"
_TWO_LINES = Dialect(
    program="names above axes",
    sign=rf"[^\n]*\n{_AXES_BELOW}",
    ends=_AXES_BELOW,
    ends_with="Frame,X,Y,Z",
    further=r"[A-Za-z#_][\w ]*[,;\t\s]*$",
    columns=_AXES_BELOW,
    names=(_AXES_BELOW, -1),
)

PLAIN = Dialect(
    program="columns named in its first line",
    sign="",
    ends="",
    ends_with="time,LKNE.x,LKNE.y,LKNE.z",
    columns="",
)
"""Any other table: the first line names the columns."""

DIALECTS = (
    _MOTIVE,
    _NEXUS,
    _OTHERS_OF_QTM,
    _QTM,
    _DEEPLABCUT,
    _ISEN,
    _COORDINATES,
    _STORAGE,
    _TWO_LINES,
)
"""By their signs, of which the first that fits counts."""
