"""A model in a shell, which starts at once."""

ONES = """\
for path in "$2"/given/*; do
    out="$2/filled/$(basename "$path")"
    mkdir "$out"
    sed s/NaN/1.0/g "$path/values.csv" > "$out/mean.csv"
done
"""
"""1 stands wherever an entry is hidden; files are folders of CSV."""
