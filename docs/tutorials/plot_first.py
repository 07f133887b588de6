"""
Fill a recording
================
"""

print("to be written")
