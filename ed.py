#!/usr/bin/env python3
# ed.py FILE <spec: blocks "<<<<\nold\n====\nnew\n>>>>"; a line "@ path" switches the file
import sys,re
spec=sys.stdin.read()
root='/tmp/w/msglib/'
path=None;bad=0
texts={}
for m in re.finditer(r'^@ (\S+)\n|^<<<<\n(.*?)\n?====\n(.*?)\n?>>>>\n',spec,re.S|re.M):
    if m.group(1): path=m.group(1); texts.setdefault(path,open(root+path).read()); continue
    old,new=m.group(2),m.group(3)
    n=texts[path].count(old)
    if n!=1: print(f'{path}: {n} times: {old[:120]!r}'); bad=1
    if n>=1: texts[path]=texts[path].replace(old,new,1) if n==1 else texts[path]
for p,t in texts.items(): open(root+p,'w').write(t)
sys.exit(bad)
