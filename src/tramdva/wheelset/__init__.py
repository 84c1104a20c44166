"""The basic model of the leading wheelset with its absorber (figures 2 to 7)."""
