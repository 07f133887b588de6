"""What a model says of itself, as data that all others read: what it can do, and what it needs.

* `abilities`: every ability by its name, in words for people;
* `needs`: every need by its name: in words, what of a problem meets it, and what ``fit`` receives.
"""
