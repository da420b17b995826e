#!/usr/bin/env python3
import re,sys,functools
root='/tmp/w/msglib/'
T={}
for l in open(root+'docs/messages.md'):
    m=re.match(r'\| `([^`]+)` \| (.*) \|$',l)
    if m: T[m.group(1)]=m.group(2).replace('\\|','|')
def tokens(t):
    out=[];i=0
    while i<len(t):
        if t[i:i+2] in('{{','}}'): out.append(t[i]); i+=2
        elif t[i]=='{':
            j=t.index('}',i); out.append(None); i=j+1
        else: out.append(t[i]); i+=1
    return out
TOK={n:tokens(t) for n,t in T.items()}
NEG=-10**6
def score(rest,tok,anch):
    n,m=len(rest),len(tok)
    # best[j] at i: iterate
    INF=NEG
    cur=[0 if (j==0 or not anch) else INF for j in range(m+1)]
    done=[]
    for i in range(n):
        # epsilon over wildcards
        for j in range(m):
            if tok[j] is None and cur[j]>cur[j+1]: cur[j+1]=cur[j]
        if cur[m]>INF and (rest[i:i+2]==', ' or rest[i:i+2]=='; '): done.append((cur[m],i))
        nxt=[INF]*(m+1)
        for j in range(m+1):
            if cur[j]<=INF: continue
            if j<m and tok[j] is None:
                if cur[j]>nxt[j]: nxt[j]=cur[j]
            elif j<m and tok[j]==rest[i]:
                if cur[j]+1>nxt[j+1]: nxt[j+1]=cur[j]+1
        cur=nxt
    for j in range(m):
        if tok[j] is None and cur[j]>cur[j+1]: cur[j+1]=cur[j]
    best=max(cur)
    r=(best,n) if best>INF else (INF,n)
    for d in done:
        if d[0]>=r[0]: r=d
    return r
def find(S):
    cands=[]
    parts=[m.end() for m in re.finditer(': ',S)]
    for k in [0]+parts:
        rest=S[k:]; anch=k>0
        if not rest: continue
        for n,tok in TOK.items():
            sc,used=score(rest,tok,anch)
            if sc<=0: continue
            place=S[:k][:-2] if k else ''
            if '`' in place or ' is ' in place: continue
            rank=sc+(0.9*len(place)+2 if k else 0)+(0.5 if n.split('.')[0] in('text','config','file','folder') else 0)
            cands.append((rank,-len(tok),n,place,rest[used:],rest[:used],sc))
    if not cands: return None
    cands.sort(key=lambda c:(-c[0],-c[1]))
    return cands
def unq(l): 
    return bytes(l,'utf8').decode('unicode_escape') if '\\' in l else l
lit=r'"(?:[^"\\]|\\.)*"'
def lits(s): return ''.join(re.findall(r'"((?:[^"\\]|\\.)*)"',s)).replace('\\"','"').replace('\\\\','\\')
def q(s): return '"'+s.replace('\\','\\\\').replace('"','\\"')+'"'
def says(text):
    b=re.findall(r'`[^`]*`',text)
    return b[0] if b else ''
def choose(S,wide=False):
    c=find(S)
    if not c: return None
    best=c[0]
    rk,_,n,place,hint,body,sc=best
    ties=[x for x in c if x[6]==sc and x[2]!=n and T[x[2]]!=T[n]]
    same=[x[2] for x in c if x[6]==sc and x[3]==place]
    if sc<max(4,0.45*len(body)): return None
    return n,place,hint,body,sc,same
if __name__=='__main__':
    for f in sys.argv[1:]:
        t=open(root+f).read(); changed=0
        def rep(m):
            global changed
            S=lits(m.group(1))
            r=choose(S)
            line=t[:m.start()].count('\n')+1
            if not r: print(f'{f}:{line}: ?? {S!r}'); return m.group(0)
            n,place,hint,body,sc,same=r
            amb=sorted(set(same))
            args=[q(n)]
            h=says(hint)
            if place or h: args.append(q(place))
            if h: args.append(q(h))
            print(f'{f}:{line}: {S!r} -> {", ".join(args)}' + ('   AMB '+str(amb) if len(amb)>1 else ''))
            return 'HasProblem('+', '.join(args)+')'
        t2=re.sub(r'(?:testing::)?HasSubstr\(\s*((?:'+lit+r'\s*)+)\)',rep,t)
        # EXPECT_EQ(call, "text") of the helpers named by HELPERS
        import os
        helpers=os.environ.get('HELPERS','problemOf|problem|refusalOf|problemsOf|said')
        def rep2(m):
            call,l=m.group(1),m.group(2)
            S=lits(l)
            if not S: return f'EXPECT_THAT({call}, IsEmpty())'
            r=choose(S.split("\\n")[0])
            if not r: print(f'{f}: EQ ?? {S!r}'); return m.group(0)
            n,place,hint,body,sc,same=r
            args=[q(n)]; h=says(hint)
            if place or h: args.append(q(place))
            if h: args.append(q(h))
            print(f'{f}: EQ {S!r} -> {", ".join(args)}'+('   AMB '+str(sorted(set(same))) if len(set(same))>1 else ''))
            return f'EXPECT_THAT({call}, ElementsAre(ProblemIs({", ".join(args)})))'
        t2=re.sub(r'EXPECT_EQ\(((?:\w+::)?(?:'+helpers+r')(?:<\w+>)?\((?:[^()"]|"(?:[^"\\]|\\.)*"|\((?:[^()"]|"(?:[^"\\]|\\.)*"|\([^()]*\))*\))*\)),\s*((?:'+lit+r'\s*)+)\)',rep2,t2)
        open(root+f,'w').write(t2)
